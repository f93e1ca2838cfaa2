/// Columns of numbers as bytes that deflate well and that a page can read back exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace whisker::page {

/// The encoding of a column: its values, their differences, or their second differences.
enum class Order { values = 0, differences = 1, second_differences = 2 };

struct Column {
  std::string name;
  Order order;
  std::int64_t per_unit;  ///< a value is the integer divided by this
  std::size_t count;
};

/// One column after the other; each integer in zigzag LEB128: 0, -1, 1, -2 become 0, 1, 2, 3, and seven bits
/// per byte follow, the lowest first, with the eighth bit set if more follow. Values before the first one are
/// zero.
class Columns {
 public:
  /// Magnitudes up to 2^50, which numbers of JavaScript hold exactly even in second differences.
  void add(const std::string& name, Order order, std::int64_t per_unit,
           const std::vector<std::int64_t>& values);

  const std::string& bytes() const { return bytes_; }
  const std::vector<Column>& list() const { return list_; }

 private:
  std::string bytes_;
  std::vector<Column> list_;
};

}  // namespace whisker::page
