// Records the golden streams, and judges the answers of the chips.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/core.h>

#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "tests/golden/compare.hpp"
#include "tests/golden/stream.hpp"

namespace {

using namespace whisker::golden;

constexpr const char* kUsage =
    "usage: whisker_golden record FOLDER\n"
    "           writes the recordings full and table, of full what the planners skirt and map "
    "say\n"
    "           (full-skirt, full-map), each with its index, and the bytes of the engine's table\n"
    "       whisker_golden judge RECORDING EXPECTED ANSWERED   exit status 1: they differ, and where\n";

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

void record(const std::string& path, const std::vector<Stream>& streams) {
  std::string index;
  const Bytes bytes = recording(streams, index);
  write(path + ".bin", reinterpret_cast<const char*>(bytes.data()), bytes.size());
  write(path + ".txt", index.data(), index.size());
}

std::vector<Stream> joined(std::vector<Stream> all, const std::vector<Stream>& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// The streams whose names start with the planner.
std::vector<Stream> of_planner(const std::vector<Stream>& all, const std::string& planner) {
  std::vector<Stream> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const Stream& stream) { return stream.name.rfind(planner + " ", 0) == 0; });
  return some;
}

/// The table in the memory layout of a little-endian target.
template <class Table>
void write_table(const std::string& path, const Table& table) {
  static_assert(std::is_trivially_copyable_v<Table> && sizeof(Table) % sizeof(std::int16_t) == 0);
  write(path, reinterpret_cast<const char*>(&table), sizeof table);
}

int record(const std::string& folder) {
  const std::vector<Stream> full = joined(joined({table_sweep()}, drives()), storms());
  record(folder + "/full", full);
  for (const char* planner : {"skirt", "map"}) {
    record(folder + "/full-" + planner, of_planner(full, planner));
  }
  record(folder + "/table", {table_sweep()});
  write_table(folder + "/engine.bin", whisker::fuzzy::kResponseTable);
  return 0;
}

/// One line of JSON, preceded by text for people.
int judge_files(const std::string& recording, const std::string& expected, const std::string& answered) {
  const Bytes index = read(recording + ".txt");
  const Judgement j = judge(read(recording + ".bin"), std::string(index.begin(), index.end()), read(expected),
                            read(answered));
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
