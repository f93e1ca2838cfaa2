#include "host/lab/page/columns.hpp"

namespace whisker::page {
namespace {

void append(std::string& bytes, std::int64_t value) {
  const auto twice = static_cast<std::uint64_t>(value) << 1U;
  std::uint64_t rest = value < 0 ? ~twice : twice;
  for (; rest >= 0x80; rest >>= 7U) bytes += static_cast<char>((rest & 0x7FU) | 0x80U);
  bytes += static_cast<char>(rest);
}

}  // namespace

void Columns::add(const std::string& name, Order order, std::int64_t per_unit,
                  const std::vector<std::int64_t>& values) {
  std::int64_t last = 0;
  std::int64_t last_difference = 0;
  for (const std::int64_t value : values) {
    const std::int64_t difference = value - last;
    switch (order) {
      case Order::values: append(bytes_, value); break;
      case Order::differences: append(bytes_, difference); break;
      case Order::second_differences: append(bytes_, difference - last_difference); break;
    }
    last = value;
    last_difference = difference;
  }
  list_.push_back({name, order, per_unit, values.size()});
}

}  // namespace whisker::page
