#include "host/campaign/merge.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>

#include "host/campaign/row_text.hpp"
#include "host/scenario/error.hpp"

namespace whisker::campaign {
namespace {

using Key = std::tuple<std::string, std::string, std::string, std::uint64_t>;

struct Found {
  Row row;
  std::string place;
};
using Rows = std::map<Key, Found>;

void add(Rows& rows, const std::string& file, std::size_t number, const std::string& line, RowFormat format) {
  Row row;
  try {
    row = parse_row(line, format);
  } catch (const std::invalid_argument& e) {
    throw InputError(file, number, 1, e.what());
  }
  const std::uint64_t seed = row.seed;
  Key key{row.world, row.planner, row.robot, seed};
  const auto [at, added] =
      rows.emplace(std::move(key), Found{std::move(row), fmt::format("{}:{}", file, number)});
  if (!added) {
    throw InputError(file, number, 1, fmt::format("seed {} is there already, in {}", seed, at->second.place));
  }
}

std::optional<RowFormat> format_of(const std::string& header) {
  for (const RowFormat format : {RowFormat::judged, RowFormat::believed}) {
    if (header == row_header(format)) return format;
  }
  return std::nullopt;
}

void add_file(Rows& rows, const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file, 1, 1, std::generic_category().message(errno));
  std::string line;
  std::size_t number = 0;
  RowFormat format{};
  while (std::getline(in, line)) {
    ++number;
    if (in.eof()) throw InputError(file, number, 1, "the last line is cut off: it has no end of line");
    if (const auto header = format_of(line)) {
      format = *header;
      continue;
    }
    if (number == 1)
      throw InputError(file, 1, 1, fmt::format("not the header of a campaign: {}", kRowHeader));
    add(rows, file, number, line, format);
  }
  if (in.bad()) throw InputError(file, number + 1, 1, "cannot be read");
  if (number == 0) throw InputError(file, 1, 1, "empty: not even the header of a campaign");
}

}  // namespace

std::vector<Row> merged(const std::vector<std::string>& files) {
  Rows rows;
  for (const std::string& file : files) add_file(rows, file);
  if (rows.empty()) throw InputError(files.front(), 1, 1, "no mission in it");
  std::vector<Row> result;
  for (auto& [key, found] : rows) result.push_back(std::move(found.row));
  return result;
}

}  // namespace whisker::campaign
