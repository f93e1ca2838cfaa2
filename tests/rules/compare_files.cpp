// Compares rule files with fuzzylite, and their tables with both: one line each. usage: whisker_rules_compare
// FILE...
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "host/harness/scenario/reader.hpp"
#include "host/lab/rules/compile.hpp"
#include "host/lab/rules/read.hpp"
#include "tests/rules/oracle.hpp"

namespace {

using namespace whisker;

bool compare_file(const std::string& file) {
  const std::string format = file.substr(file.rfind('.') + 1);
  rules::RuleBase base = rules::read_rules(file);
  std::printf("%s: ", file.c_str());
  bool right = true;
  if (test::comparable(base)) {
    const test::Agreement a = test::compare(read_file(file), format, base, 40, 7);
    std::printf("%d answers agree%s%s, ", a.points + a.silent, a.disagrees.empty() ? "" : " BUT ",
                a.disagrees.c_str());
    right = a.disagrees.empty();
  } else {
    std::printf("fuzzylite defines its defuzzifier otherwise, ");
  }
  // Inputs beyond the second are held in the middle.
  rules::Options options;
  for (std::size_t i = 2; i < base.inputs.size(); ++i)
    options.fixed.push_back({i, (base.inputs[i].low + base.inputs[i].high) / 2});
  const rules::Compiled c = rules::compile(base, options);
  std::printf("%zu bytes, %.2f s", c.table.bytes(), c.seconds);
  for (std::size_t o = 0; o < c.errors.size(); ++o)
    std::printf(", %.3f %%", c.spans[o] > 0 ? 100 * c.errors[o].greatest / c.spans[o] : 0);
  std::printf("\n");
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  int wrong = 0;
  int done = 0;
  for (int i = 1; i < argc; ++i) {
    try {
      wrong += compare_file(argv[i]) ? 0 : 1;
      ++done;
    } catch (const std::exception& error) {
      std::printf("not compiled: %s\n", error.what());
    }
    std::fflush(stdout);
  }
  std::printf("%d of %d files compiled, %d disagree\n", done, argc - 1, wrong);
  return wrong == 0 ? 0 : 1;
}
