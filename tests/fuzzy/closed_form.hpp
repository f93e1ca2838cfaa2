/// Exact inference in closed form, an oracle for the engine and for Exact.
#pragma once

#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

/// Gives the results of Exact, bit for bit, for any rule base, at the cost of two divisions.
class ClosedForm {
 public:
  using Table = RuleBase;

  /// The table must outlive the engine. A change of the table takes effect in the next response.
  explicit constexpr ClosedForm(const Table& table) noexcept : table_(&table) {}
  ClosedForm(const Table&&) = delete;

  Response operator()(Inputs in) const noexcept;

 private:
  const Table* table_;
};

}  // namespace whisker::fuzzy
