/// Any bytes as a scenario file: the result is a scenario that survives writing and reading, or a one-line
/// error.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/write.hpp"

namespace {

constexpr const char* kName = "fuzz.toml";

void require(bool holds, std::string_view what, const std::string& text) {
  if (holds) return;
  std::cerr << what << ":\n" << text << "\n";
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  whisker::Scenario scenario;
  try {
    scenario = whisker::parse_scenario(text, kName);
  } catch (const whisker::InputError& error) {
    const std::string message = error.what();
    require(message.rfind(std::string(kName) + ":", 0) == 0,
            "the message does not begin with FILE:", message);
    require(message.find('\n') == std::string::npos, "the message has more than one line", message);
    return 0;
  }
  const std::string written = whisker::to_toml(scenario);
  whisker::Scenario again = whisker::parse_scenario(written, kName);
  // to_toml guarantees the heading within one unit in the last place, and all else bit for bit.
  require(std::abs(again.start.heading - scenario.start.heading) < 1e-9, "another heading", written);
  again.start.heading = scenario.start.heading;
  require(whisker::to_toml(again) == written, "written, read and written again: differs", written);
  return 0;
}
