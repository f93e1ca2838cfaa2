/// Numbers in columns, as bytes that deflate well and that a page can read back exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace whisker::page {

/// How a column is written: as its values, their differences, or the differences of those.
enum class Order { values = 0, differences = 1, second_differences = 2 };

struct Column {
  std::string name;
  Order order;
  std::int64_t per_unit;  ///< a value is the integer divided by this
  std::size_t count;
};

/// One column after the other; each integer in zigzag LEB128: 0, -1, 1, -2 become 0, 1, 2, 3, and seven bits
/// a byte follow, the lowest first, the eighth set where more come. Before the first value lie zeros.
class Columns {
 public:
  /// Magnitudes up to 2^50, which a page's numbers hold exactly even in second differences.
  void add(const std::string& name, Order order, std::int64_t per_unit,
           const std::vector<std::int64_t>& values);

  const std::string& bytes() const { return bytes_; }
  const std::vector<Column>& list() const { return list_; }

 private:
  std::string bytes_;
  std::vector<Column> list_;
};

}  // namespace whisker::page
