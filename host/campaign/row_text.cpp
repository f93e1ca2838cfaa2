#include "host/campaign/row_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "host/campaign/worlds.hpp"
#include "host/report/result.hpp"

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
  explicit Fields(std::string_view line) : rest_(line) {}

  std::string text(const char* column) {
    if (ended_) throw std::invalid_argument(fmt::format("no column {}", column));
    std::string field;
    bool quotes = false;
    std::size_t i = 0;
    for (; i < rest_.size() && (quotes || rest_[i] != ','); ++i) {
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

bool contradicts_itself(const Row& r) { return says_reached(r.verdict) && r.at_goal != truly_there(r); }

}  // namespace

const char* const kRowHeader =
    "seed,outcome,time_s,path_m,turned_rad,stops,flips,looks,min_clearance_m,final_distance_m,"
    "estimate_error_m,at_goal,shortest_m,ratio,s_per_m,ticks,hash,detail,planner,robot,world,"
    "believed_distance_m,truly_there";

std::string_view row_header(RowFormat format) {
  const std::string_view all = kRowHeader;
  return format == RowFormat::judged ? all : all.substr(0, all.find(",believed_distance_m"));
}

std::string to_csv(const Row& r) {
  return fmt::format("{},{},{}", first_columns(r), number(r.believed_distance_m), truly_there(r) ? 1 : 0);
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
  if (contradicts_itself(r) || to_csv(r) != line) throw std::invalid_argument(kNoSuchRow);
  return r;
}

}  // namespace whisker::campaign
