#include "host/lab/campaign/row_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/harness/scenario/csv.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/lab/campaign/worlds.hpp"
#include "host/lab/report/result.hpp"

namespace whisker::campaign {
namespace {

constexpr Verdict kVerdicts[] = {Verdict::reached, Verdict::off_goal, Verdict::unreachable,
                                 Verdict::gave_up, Verdict::contact,  Verdict::fault};
constexpr const char* kNoSuchRow = "the row is not one that campaign writes";

std::string number(std::optional<double> x) { return x ? fmt::format("{:.6f}", *x) : std::string(); }

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result.append(c == '"' ? 2 : 1, c);
  return result + '"';
}

/// Reads one unquoted field after the other; errors name the column.
class Fields {
 public:
  explicit Fields(std::string_view line, char separator = ',') : rest_(line), separator_(separator) {}

  bool ended() const { return ended_; }

  std::string text(const char* column) {
    if (ended_) throw std::invalid_argument(fmt::format("no column {}", column));
    std::string field;
    bool quotes = false;
    std::size_t i = 0;
    for (; i < rest_.size() && (quotes || rest_[i] != separator_); ++i) {
      const bool doubled = quotes && rest_.substr(i, 2) == "\"\"";
      if (rest_[i] != '"' || doubled) field += rest_[i];
      if (doubled) {
        ++i;
      } else if (rest_[i] == '"') {
        quotes = !quotes;
      }
    }
    if (has_control_characters(field)) {
      throw std::invalid_argument(fmt::format("column {}: control characters in it", column));
    }
    ended_ = i >= rest_.size();
    rest_.remove_prefix(ended_ ? rest_.size() : i + 1);
    return field;
  }

  template <class T>
  T number(const char* column, int base = 10) {
    const std::string field = text(column);
    const char* const end = field.data() + field.size();
    T value{};
    std::from_chars_result result{};
    if constexpr (std::is_floating_point_v<T>) {
      result = std::from_chars(field.data(), end, value, std::chars_format::fixed);
    } else {
      result = std::from_chars(field.data(), end, value, base);
    }
    bool good = result.ec == std::errc{} && result.ptr == end;
    if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
    if (!good) {
      throw std::invalid_argument(fmt::format("column {}: '{}' is no such number", column, field));
    }
    return value;
  }

  double amount(const char* column) {
    const double value = number<double>(column);
    if (value < 0) throw std::invalid_argument(fmt::format("column {}: {} is negative", column, value));
    return value;
  }

  std::optional<double> amount_or_none(const char* column) {
    if (rest_.empty() || rest_.front() == ',') {
      text(column);
      return std::nullopt;
    }
    return amount(column);
  }

 private:
  std::string_view rest_;
  char separator_;
  bool ended_ = false;
};

Verdict verdict_named(const std::string& word) {
  for (const Verdict verdict : kVerdicts) {
    if (word == report::outcome(verdict)) return verdict;
  }
  throw std::invalid_argument(fmt::format("column outcome: '{}' is none", word));
}

/// The columns of RowFormat::believed.
std::string first_columns(const Row& r) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:016x},{},{},{},{}", r.seed,
                     report::outcome(r.verdict), number(r.time_s), number(r.path_m), number(r.turned_rad),
                     r.stops, r.flips, r.looks, number(r.min_clearance_m), number(r.final_distance_m),
                     number(r.estimate_error_m), r.at_goal ? 1 : 0, number(r.shortest_m), number(ratio(r)),
                     number(s_per_m(r)), r.ticks, r.hash, quoted(r.detail), quoted(r.planner),
                     quoted(r.robot), quoted(r.world));
}

/// Reads what first_columns() writes.
Row first_columns(Fields& fields) {
  Row r;
  r.seed = fields.number<std::uint64_t>("seed");
  r.verdict = verdict_named(fields.text("outcome"));
  r.time_s = fields.amount("time_s");
  r.path_m = fields.amount("path_m");
  r.turned_rad = fields.amount("turned_rad");
  r.stops = fields.number<std::uint64_t>("stops");
  r.flips = fields.number<std::uint64_t>("flips");
  r.looks = fields.number<std::uint64_t>("looks");
  r.min_clearance_m = fields.number<double>("min_clearance_m");
  r.final_distance_m = fields.amount("final_distance_m");
  r.estimate_error_m = fields.amount("estimate_error_m");
  r.at_goal = fields.text("at_goal") == "1";
  r.shortest_m = fields.amount_or_none("shortest_m");
  fields.text("ratio");
  fields.text("s_per_m");
  r.ticks = fields.number<std::uint64_t>("ticks");
  r.hash = fields.number<std::uint64_t>("hash", 16);
  r.detail = fields.text("detail");
  r.planner = fields.text("planner");
  r.robot = fields.text("robot");
  r.world = fields.text("world");
  return r;
}

bool contradicts_itself(const Row& r) {
  return (says_reached(r.verdict) && r.at_goal != truly_there(r)) || r.mission > r.missions;
}

using Key = std::tuple<std::string, std::string, std::string, std::uint64_t>;

struct Found {
  Row row;
  std::string place;
};
using Rows = std::map<Key, Found>;

std::optional<RowFormat> format_of(std::string header) {
  std::replace(header.begin(), header.end(), ';', ',');
  for (const RowFormat format : {RowFormat::numbered, RowFormat::judged, RowFormat::believed}) {
    if (header == row_header(format)) return format;
  }
  return std::nullopt;
}

/// Of a spreadsheet: 0,5 for 0.500000.
std::string six_decimals(std::string text) {
  std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  return error == std::errc{} && stop == end ? number(value) : text;
}

/// The row as campaign writes it, of one that a spreadsheet has saved.
std::string as_written(std::string_view line, char separator, RowFormat format) {
  Fields fields(line, separator);
  Fields columns(row_header(format));
  std::string row;
  while (!columns.ended()) {
    const std::string column = columns.text("");
    const std::string field = fields.text(column.c_str());
    const auto ends = [&](std::string_view end) {
      return column.size() >= end.size() && column.substr(column.size() - end.size()) == end;
    };
    const bool measured = column == "ratio" || ends("_m") || ends("_s") || ends("_rad");
    row += (row.empty() ? "" : ",") + quoted(measured ? six_decimals(field) : field);
  }
  if (!fields.ended()) throw std::invalid_argument(kNoSuchRow);
  return row;
}

void add(Rows& rows, const std::string& file, std::size_t number, const std::string& line, char separator,
         RowFormat format) {
  Row row;
  try {
    row = parse_row(as_written(line, separator, format), format);
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

/// Reads the lines of a file in `text`.
void add_text(Rows& rows, const std::string& file, const std::string& text) {
  std::istringstream in(text);
  LineReader lines(in, file);
  RowFormat format{};
  char separator = ',';
  while (lines.next()) {
    if (lines.cut()) lines.fail(1, "the last line is cut off: it has no end of line");
    if (const auto header = format_of(lines.line())) {
      format = *header;
      separator = lines.line().find(';') == std::string::npos ? ',' : ';';
      continue;
    }
    if (lines.number() == 1) lines.fail(1, fmt::format("not the header of a campaign: {}", kRowHeader));
    add(rows, file, lines.number(), lines.line(), separator, format);
  }
  if (lines.number() == 1) throw InputError(file, 1, 1, "empty: not even the header of a campaign");
}

void add_file(Rows& rows, const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(file, 1, 1, std::generic_category().message(errno));
  std::ostringstream text;
  if (in.peek() != std::ifstream::traits_type::eof()) text << in.rdbuf();
  if (in.bad() || text.bad()) throw InputError(file, 1, 1, "cannot read the file");
  add_text(rows, file, text.str());
}

/// What tells campaigns apart: planner, robot (random ones count as one), worlds, first seed, number of
/// missions.
using Campaign = std::tuple<std::string, std::string, std::string, std::uint64_t, std::uint64_t>;

Campaign campaign_of(const Row& r) {
  const bool files = is_scenario_file(r.world);
  const std::string robot = r.robot.rfind("random ", 0) == 0 ? "random" : r.robot;
  return {r.planner, robot, files ? r.world.substr(0, r.world.rfind('/') + 1) : r.world,
          files ? 0 : r.seed - r.mission, r.missions};
}

void check_whole(const Rows& rows, const std::string& file) {
  std::map<Campaign, std::set<std::uint64_t>> all;
  for (const auto& [key, found] : rows) {
    if (found.row.missions > 0) all[campaign_of(found.row)].insert(found.row.mission);
  }
  for (const auto& [campaign, missions] : all) {
    const std::uint64_t wanted = std::get<4>(campaign);
    if (missions.size() == wanted) continue;
    std::uint64_t first = 1;
    while (missions.count(first) != 0) ++first;
    throw InputError(file, 1, 1,
                     fmt::format("{} of {} missions of {} are missing, the first is number {}: --incomplete "
                                 "merges what there is",
                                 wanted - missions.size(), wanted, std::get<2>(campaign), first));
  }
}

}  // namespace

const char* const kRowHeader =
    "seed,outcome,time_s,path_m,turned_rad,stops,flips,looks,min_clearance_m,final_distance_m,"
    "estimate_error_m,at_goal,shortest_m,ratio,s_per_m,ticks,hash,detail,planner,robot,world,"
    "believed_distance_m,truly_there,mission,missions";

std::string_view row_header(RowFormat format) {
  const std::string_view all = kRowHeader;
  if (format == RowFormat::numbered) return all;
  return all.substr(0, all.find(format == RowFormat::judged ? ",mission," : ",believed_distance_m"));
}

std::string to_csv(const Row& r) {
  return fmt::format("{},{},{},{},{}", first_columns(r), number(r.believed_distance_m),
                     truly_there(r) ? 1 : 0, r.mission, r.missions);
}

Row parse_row(std::string_view line, RowFormat format) {
  Fields fields(line);
  Row r = first_columns(fields);
  if (format == RowFormat::believed) {
    if (r.verdict == Verdict::off_goal || first_columns(r) != line) throw std::invalid_argument(kNoSuchRow);
    if (r.verdict == Verdict::reached && !r.at_goal) r.verdict = Verdict::off_goal;
    return r;
  }
  r.believed_distance_m = fields.amount_or_none("believed_distance_m");
  fields.text("truly_there");
  std::string written = to_csv(r);
  if (format == RowFormat::judged) {
    written.resize(written.size() - std::string_view(",0,0").size());
  } else {
    r.mission = fields.number<std::uint64_t>("mission");
    r.missions = fields.number<std::uint64_t>("missions");
    written = to_csv(r);
  }
  if (contradicts_itself(r) || written != line) throw std::invalid_argument(kNoSuchRow);
  return r;
}

RowFile::RowFile(const std::string& path) : file_(path) {
  const std::string header = fmt::format("{}\n", kRowHeader), text = file_.found();
  if (text.size() < header.size() && header.rfind(text, 0) == 0) {
    file_.keep(0);
    file_.write(header);
    return;
  }
  if (text.rfind(header, 0) != 0)
    throw InputError(part(), 1, 1, "not the rows of a campaign of this version");
  // A killed process may leave a piece of a row.
  const std::size_t whole = text.rfind('\n') + 1;
  Rows rows;
  add_text(rows, part(), text.substr(0, whole));
  for (auto& [key, found] : rows) found_.push_back(std::move(found.row));
  std::sort(found_.begin(), found_.end(), [](const Row& a, const Row& b) { return a.mission < b.mission; });
  file_.keep(whole);
}

void RowFile::add(const Row& row) { file_.write(fmt::format("{}\n", to_csv(row))); }

std::vector<Row> merged(const std::vector<std::string>& files, bool incomplete) {
  Rows rows;
  for (const std::string& file : files) add_file(rows, file);
  if (rows.empty()) throw InputError(files.front(), 1, 1, "no mission in it");
  if (!incomplete) check_whole(rows, files.front());
  std::vector<Row> result;
  for (auto& [key, found] : rows) result.push_back(std::move(found.row));
  return result;
}

}  // namespace whisker::campaign
