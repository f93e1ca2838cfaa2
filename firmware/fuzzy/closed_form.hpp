/// The closed-form engine: exact inference on the bare rule base, 100 bytes.
#pragma once

#include "firmware/fuzzy/variables.hpp"

namespace whisker::fuzzy {

/// Gives what Exact gives, bit for bit, for any rule base, at the price of two divisions.
class ClosedForm {
 public:
  using Table = RuleBase;

  /// The table must outlive the engine; its changes take effect at once.
  explicit constexpr ClosedForm(const Table& table) noexcept : table_(&table) {}
  ClosedForm(const Table&&) = delete;

  Response operator()(Inputs in) const noexcept;

 private:
  const Table* table_;
};

}  // namespace whisker::fuzzy
