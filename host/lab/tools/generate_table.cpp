// Writes the look-up table of the committed rules.
#include <cstdio>
#include <fstream>

#include "firmware/fuzzy/rules.hpp"
#include "host/lab/tools/table_text.hpp"

int main(int argc, char** argv) {
  using namespace whisker;
  if (argc != 2 || argv[1][0] == '-') {
    std::fputs("usage: whisker_generate_table FILE.hpp\n", stderr);
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
