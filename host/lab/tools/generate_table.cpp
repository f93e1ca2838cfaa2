// Writes the look-up table of the committed rules, or prints the cost of other grids.
#include <cstdio>
#include <cstring>
#include <fstream>

#include "firmware/fuzzy/rules.hpp"
#include "host/lab/tools/grid_report.hpp"
#include "host/lab/tools/table_text.hpp"

int main(int argc, char** argv) {
  using namespace whisker;
  if (argc == 2 && std::strcmp(argv[1], "--grids") == 0) {
    std::fputs(tools::grid_report(fuzzy::kRules).c_str(), stdout);
    return 0;
  }
  if (argc != 2 || argv[1][0] == '-') {
    std::fputs("usage: whisker_generate_table FILE.hpp | --grids\n", stderr);
    return 2;
  }
  std::ofstream file{argv[1], std::ios::binary};
  file << tools::response_table_text(fuzzy::kRules);
  file.close();
  if (!file) {
    std::fprintf(stderr, "%s: cannot be written\n", argv[1]);
    return 1;
  }
  return 0;
}
