#include "host/harness/scenario/reader.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/nesting.hpp"
#include "host/harness/scenario/text.hpp"

namespace whisker {
namespace {

InputError error_in(const std::string& file, toml::source_position at, std::string_view what) {
  return {file, at.line == 0 ? 1 : at.line, at.column == 0 ? 1 : at.column, what};
}

[[noreturn]] void fail_in(const std::string& file, toml::source_position at, std::string_view what) {
  throw error_in(file, at, what);
}

bool before(toml::source_position a, toml::source_position b) {
  return a.line != b.line ? a.line < b.line : a.column < b.column;
}

const char* kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::none: return "nothing";
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "an array";
    case toml::node_type::string: return "a string";
    case toml::node_type::integer: return "an integer";
    case toml::node_type::floating_point: return "a float";
    case toml::node_type::boolean: return "a boolean";
    case toml::node_type::date: return "a date";
    case toml::node_type::time: return "a time";
    case toml::node_type::date_time: return "a date and time";
  }
  return "?";
}

std::string describe(Limits limits) {
  if (limits.low_excluded) return fmt::format("greater than {} and at most {}", limits.low, limits.high);
  return fmt::format("from {} to {}", limits.low, limits.high);
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  check_nesting(text, file);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    fail_in(file, error.source().begin, error.description());
  }
}

TableReader::TableReader(const std::string& file, const toml::table& table, std::string title,
                         const std::vector<std::string_view>& known)
    : file_(file), table_(table), title_(std::move(title)) {
  const toml::key* first = nullptr;
  for (const auto& [key, value] : table) {
    bool found = false;
    for (const std::string_view k : known) found = found || key == k;
    if (!found && (first == nullptr || before(key.source().begin, first->source().begin))) first = &key;
  }
  if (first == nullptr) return;
  const std::string_view near = nearest_word(first->str(), known);
  fail_in(file_, first->source().begin,
          fmt::format("unknown key '{}'{}{}", first->str(), title_.empty() ? "" : " in " + title_,
                      near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

void TableReader::fail(const toml::node& node, std::string_view what) const {
  fail_in(file_, node.source().begin, what);
}

InputError TableReader::error(std::string_view what) const {
  return error_in(file_, table_.source().begin, what);
}

InputError TableReader::error_at(std::string_view key, std::string_view what) const {
  return error_in(file_, require(key).source().begin, what);
}

std::size_t TableReader::line_of(std::string_view key) const { return require(key).source().begin.line; }

void TableReader::fail(std::string_view what) const { throw error(what); }

void TableReader::fail_at(std::string_view key, std::string_view what) const { fail(require(key), what); }

const toml::node& TableReader::require(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) fail(fmt::format("{}'{}' is missing", title_.empty() ? "" : title_ + ": ", key));
  return *node;
}

double TableReader::number(std::string_view key, const toml::node& node, Limits limits) const {
  double x = 0;
  if (const auto* integer = node.as_integer()) {
    x = static_cast<double>(integer->get());
  } else if (const auto* floating = node.as_floating_point()) {
    x = floating->get();
  } else {
    fail(node, fmt::format("'{}' must be a number, but is {}", key, kind_of(node)));
  }
  if (!std::isfinite(x)) fail(node, fmt::format("'{}' must be a finite number, but is {}", key, x));
  if (x < limits.low || x > limits.high || (limits.low_excluded && x == limits.low)) {
    fail(node, fmt::format("'{}' must be {}, but is {}", key, describe(limits), x));
  }
  return x;
}

double TableReader::number(std::string_view key, Limits limits) const {
  return number(key, require(key), limits);
}

double TableReader::number_or(std::string_view key, Limits limits, double fallback) const {
  return has(key) ? number(key, limits) : fallback;
}

std::int64_t TableReader::integer(std::string_view key, std::int64_t low, std::int64_t high) const {
  const toml::node& node = require(key);
  const auto* integer = node.as_integer();
  if (integer == nullptr) fail(node, fmt::format("'{}' must be an integer, but is {}", key, kind_of(node)));
  const std::int64_t x = integer->get();
  if (x < low || x > high)
    fail(node, fmt::format("'{}' must be from {} to {}, but is {}", key, low, high, x));
  return x;
}

bool TableReader::boolean(std::string_view key) const {
  const toml::node& node = require(key);
  const auto* boolean = node.as_boolean();
  if (boolean == nullptr)
    fail(node, fmt::format("'{}' must be true or false, but is {}", key, kind_of(node)));
  return boolean->get();
}

std::string TableReader::text(std::string_view key) const {
  const toml::node& node = require(key);
  const auto* string = node.as_string();
  if (string == nullptr) fail(node, fmt::format("'{}' must be a string, but is {}", key, kind_of(node)));
  for (const char c : string->get()) {
    if ((c >= 0 && c < ' ') || c == '\x7F') fail(node, fmt::format("'{}' must be one line of text", key));
  }
  return string->get();
}

sim::Vec2 TableReader::point(std::string_view key, const toml::node& node) const {
  const auto* pair = node.as_array();
  if (pair == nullptr) {
    fail(node, fmt::format("'{}': a point is [x, y] in metres, but this is {}", key, kind_of(node)));
  }
  if (pair->size() != 2) {
    fail(node, fmt::format("'{}': a point is [x, y] in metres, but this has {} numbers", key, pair->size()));
  }
  return {number(key, (*pair)[0], kCoordinate), number(key, (*pair)[1], kCoordinate)};
}

sim::Vec2 TableReader::point(std::string_view key) const { return point(key, require(key)); }

std::vector<sim::Vec2> TableReader::points(std::string_view key, std::size_t fewest, std::size_t most) const {
  const toml::node& node = require(key);
  const auto* array = node.as_array();
  if (array == nullptr) {
    fail(node, fmt::format("'{}' must be an array of points, but is {}", key, kind_of(node)));
  }
  if (array->size() < fewest || array->size() > most) {
    fail(node,
         fmt::format("'{}' must have from {} to {} points, but has {}", key, fewest, most, array->size()));
  }
  std::vector<sim::Vec2> points;
  points.reserve(array->size());
  for (const toml::node& element : *array) {
    const sim::Vec2 p = point(key, element);
    if (!points.empty() && points.back().x == p.x && points.back().y == p.y) {
      fail(element,
           fmt::format("'{}': points {} and {} are the same", key, points.size(), points.size() + 1));
    }
    points.push_back(p);
  }
  return points;
}

TableReader TableReader::table(std::string_view key, const std::vector<std::string_view>& known) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) fail(fmt::format("[{}] is missing", key));
  const auto* table = node->as_table();
  if (table == nullptr) fail(*node, fmt::format("'{}' must be a table, but is {}", key, kind_of(*node)));
  return {file_, *table, fmt::format("[{}]", key), known};
}

std::vector<TableReader> TableReader::tables(std::string_view key,
                                             const std::vector<std::string_view>& known) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return {};
  const auto* array = node->as_array();
  if (array == nullptr) {
    fail(*node, fmt::format("'{0}' must be an array of tables, [[{0}]], but is {1}", key, kind_of(*node)));
  }
  std::vector<TableReader> readers;
  for (const toml::node& element : *array) {
    const auto* table = element.as_table();
    if (table == nullptr) {
      fail(element,
           fmt::format("'{0}' must be an array of tables, [[{0}]], but holds {1}", key, kind_of(element)));
    }
    readers.emplace_back(file_, *table, fmt::format("[[{}]] {}", key, readers.size() + 1), known);
  }
  return readers;
}

}  // namespace whisker
