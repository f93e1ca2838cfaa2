// Records the golden streams, and judges what chips answered to them.
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <fmt/core.h>

#include "tests/golden/compare.hpp"
#include "tests/golden/stream.hpp"

namespace {

using whisker::chip::Bytes;
using namespace whisker::golden;

constexpr const char* kUsage =
    "usage: whisker_golden record FOLDER                       writes FOLDER/stream.bin and FOLDER/index.txt\n"
    "       whisker_golden judge FOLDER EXPECTED ANSWERED      exit status 1: they differ, and where\n";

Bytes read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const std::string& path, const char* data, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(data, static_cast<std::streamsize>(size));
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

int record(const std::string& folder) {
  std::string index;
  const Bytes bytes = recording(index);
  write(folder + "/stream.bin", reinterpret_cast<const char*>(bytes.data()), bytes.size());
  write(folder + "/index.txt", index.data(), index.size());
  return 0;
}

/// One line of JSON for programs, and for a person the words before it.
int judge_files(const std::string& folder, const std::string& expected, const std::string& answered) {
  const Bytes index = read(folder + "/index.txt");
  const Judgement j =
      judge(read(folder + "/stream.bin"), std::string(index.begin(), index.end()), read(expected), read(answered));
  if (!j.difference.empty()) {
    fmt::print("{}\n", j.difference);
    return 1;
  }
  std::string costs;
  for (const Cost& c : j.costs) {
    costs += fmt::format("{}{{\"stream\": \"{}\", \"ticks\": {}, \"work\": {}, \"worst\": {}}}",
                         costs.empty() ? "" : ", ", c.name, c.ticks, c.work, c.worst);
  }
  fmt::print("{{\"ticks\": {}, \"hash\": \"{:016x}\", \"stack\": {}, \"streams\": [{}]}}\n", j.total.ticks,
             j.total.hash, j.total.stack, costs);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  try {
    if (command == "record" && argc == 3) return record(argv[2]);
    if (command == "judge" && argc == 5) return judge_files(argv[2], argv[3], argv[4]);
  } catch (const std::exception& e) {
    fmt::print(stderr, "whisker_golden: {}\n", e.what());
    return 2;
  }
  std::fputs(kUsage, stderr);
  return 2;
}
