/// Strict reader of one TOML table: every error is an InputError with its position in the file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/limits.hpp"
#include "host/harness/sim/geometry.hpp"

namespace whisker {

/// Reads and checks whole files.
toml::table parse_toml(std::string_view text, const std::string& file);
/// At most 16 MiB. Throws InputError if the file cannot be read.
std::string read_file(const std::string& file);

class TableReader {
 public:
  /// `title` names the table in messages ("[start]"); empty for the file's top level.
  /// A key outside `known` is an error.
  TableReader(const std::string& file, const toml::table& table, std::string title,
              const std::vector<std::string_view>& known);

  bool has(std::string_view key) const { return table_.contains(key); }

  double number(std::string_view key, Limits limits) const;
  double number_or(std::string_view key, Limits limits, double fallback) const;
  /// A TOML integer in [low, high].
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high) const;
  bool boolean(std::string_view key) const;
  /// One line of text.
  std::string text(std::string_view key) const;
  sim::Vec2 point(std::string_view key) const;
  /// At least `fewest` points; neighbouring points differ.
  std::vector<sim::Vec2> points(std::string_view key, std::size_t fewest, std::size_t most) const;

  TableReader table(std::string_view key, const std::vector<std::string_view>& known) const;
  /// One reader for each [[key]]; none if the key is missing.
  std::vector<TableReader> tables(std::string_view key, const std::vector<std::string_view>& known) const;

  /// An error at the position of the table, or of the key's value.
  InputError error(std::string_view what) const;
  InputError error_at(std::string_view key, std::string_view what) const;
  /// The line of the key's value.
  std::size_t line_of(std::string_view key) const;
  /// Throws that error.
  [[noreturn]] void fail(std::string_view what) const;
  [[noreturn]] void fail_at(std::string_view key, std::string_view what) const;

 private:
  const toml::node& require(std::string_view key) const;
  [[noreturn]] void fail(const toml::node& node, std::string_view what) const;
  double number(std::string_view key, const toml::node& node, Limits limits) const;
  sim::Vec2 point(std::string_view key, const toml::node& node) const;

  const std::string& file_;
  const toml::table& table_;
  std::string title_;
};

}  // namespace whisker
