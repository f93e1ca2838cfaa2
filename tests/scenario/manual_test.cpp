// The table of docs/parameters.md is the generated one, and the example of docs/scenario.md loads.
#include <gtest/gtest.h>

#include "host/scenario/load.hpp"
#include "host/scenario/params_text.hpp"
#include "host/scenario/reader.hpp"

namespace whisker {
namespace {

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  if (from == std::string::npos) return {};
  const std::size_t to = text.find(end, from + begin.size());
  if (to == std::string::npos) return {};
  return text.substr(from + begin.size(), to - from - begin.size());
}

std::string page(const std::string& name) { return read_file(WHISKER_SOURCE_DIR "/docs/" + name); }

TEST(Manual, ListsEveryParameterAsTheCodeHasIt) {
  EXPECT_EQ(between(page("parameters.md"), "<!-- params:begin -->\n", "<!-- params:end -->"),
            params_markdown());
}

TEST(Manual, ShowsAnExampleThatLoads) {
  const std::string example = between(page("scenario.md"), "```toml\n", "```");
  const Scenario s = parse_scenario(example, "example");
  EXPECT_EQ(s.discs.size() + s.polygons.size() + s.walls.size() + s.movers.size(), 4U);
}

}  // namespace
}  // namespace whisker
