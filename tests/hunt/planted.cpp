// Judges one part of the core with these seeds; planted_test.py links it with a defect.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "host/lab/hunt/parts/parts.hpp"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::uint64_t first = std::strtoull(argv[2], nullptr, 10),
                      count = std::strtoull(argv[3], nullptr, 10);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const std::string wrong = whisker::hunt::judge_part(argv[1], seed);
    if (wrong.empty()) continue;
    std::printf("%s\n", wrong.c_str());
    return 1;
  }
  return 0;
}
