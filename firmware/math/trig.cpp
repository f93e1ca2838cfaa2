#include "firmware/math/trig.hpp"

namespace whisker::at_run_time {

Q30 sin(Angle a) noexcept { return formula::sin(a); }
Angle atan2(int32_t y, int32_t x) noexcept { return formula::atan2(y, x); }
uint32_t square_root(uint64_t x) noexcept { return formula::square_root(x); }
uint32_t square_root_32(uint32_t x) noexcept { return formula::square_root_32(x); }
Length norm(Vec v) noexcept { return formula::norm(v); }
bool farther(Vec v, Length length) noexcept { return formula::farther(v, length); }
Vec polar(Angle direction, Length length) noexcept { return formula::polar(direction, length); }
Length along(Vec v, Facing direction) noexcept { return formula::along(v, direction); }

}  // namespace whisker::at_run_time
