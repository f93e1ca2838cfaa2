#include "firmware/planning/global/wavefront.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kBeyond = 6;   // levels past the body's, for the cells around the body
constexpr int32_t kDetour = 20;  // levels: extra cost of a detour outside the window

int32_t gap(int32_t x, int32_t size) noexcept { return x < 0 ? -x : x >= size ? x - size + 1 : 0; }

}  // namespace

int32_t cell_distance(Cell d) noexcept {
  const int32_t x = absolute(d.x);
  const int32_t y = absolute(d.y);
  const int32_t longer = x > y ? x : y;
  const int32_t both = (2 * (x + y) + 2) / 3;
  return longer > both ? longer : both;
}

int32_t Wavefront::farthest(const GridMap& map) const noexcept {
  const int32_t columns = map.shape().columns() - 1;
  const int32_t rows = map.shape().rows - 1;
  const Cell& g = task_.goal;
  const int32_t x = absolute(g.x) > absolute(columns - g.x) ? g.x : columns - g.x;
  const int32_t y = absolute(g.y) > absolute(rows - g.y) ? g.y : rows - g.y;
  return cell_distance({x, y}) + detour_;
}

void Wavefront::begin(GridMap& map, const Task& task) noexcept {
  *this = Wavefront{};
  task_ = task;
  over_ = false;
  GridWord* const levels = map.level_high();
  for (int32_t i = 2 * map.shape().size(); i-- > 0;) levels[i] = 0;
  if (map.holds(task.goal)) {
    const int32_t i = task.goal.y * map.shape().words + task.goal.x / kWordBits;
    map.level_low()[i] |= GridWord{1} << (task.goal.x % kWordBits);
    low_ = high_ = task.goal.y;
    if (task.goal == task.body) reached_ = 0;
    level_ = 1;
  } else {
    entry_ = Entry::facing_border;
    level_ = cell_distance({gap(task.goal.x, map.shape().columns()), gap(task.goal.y, map.shape().rows)});
  }
  begin_level(map);
}

void Wavefront::begin_level(const GridMap& map) noexcept {
  new_low_ = INT16_MAX;
  new_high_ = -1;
  row_ = low_ - 1;
  last_ = high_ + 1;
  if (high_ < 0) {
    row_ = INT16_MAX;
    last_ = -1;
  }
  if (entry_ != Entry::goal) {
    const int32_t l = level_ - detour_;
    if (task_.goal.y - l < row_) row_ = task_.goal.y - l;
    if (task_.goal.y + l > last_) last_ = task_.goal.y + l;
  }
  if (row_ < 0) row_ = 0;
  if (last_ > map.shape().rows - 1) last_ = map.shape().rows - 1;
}

bool Wavefront::end_level(GridMap& map) noexcept {
  low_ = new_low_;
  high_ = new_high_;
  const bool pending = entry_ != Entry::goal && level_ < farthest(map);
  if (reached_ < 0 && phase(map, task_.body) == level_ % 3) reached_ = level_;
  if (reached_ >= 0 && level_ >= reached_ + kBeyond) return true;
  if (level_ >= task_.most) return true;
  if (high_ < 0 && !pending) {
    if (reached_ >= 0 || entry_ == Entry::any_border || !reaches_border(map)) return true;
    // There may be a detour outside the window.
    entry_ = Entry::any_border;
    const int32_t inside =
        cell_distance({gap(task_.goal.x, map.shape().columns()), gap(task_.goal.y, map.shape().rows)});
    detour_ = level_ - inside > kDetour ? level_ - inside : kDetour;
    level_ = inside + detour_ - 1;
  }
  ++level_;
  begin_level(map);
  return false;
}

bool Wavefront::reaches_border(const GridMap& map) const noexcept {
  // A blocked goal has a level, but not as a cell where the wavefront has been.
  if (map.holds(task_.goal) && map.at_rim(task_.goal)) return true;
  const int words = map.shape().words;
  const int32_t rows = map.shape().rows;
  const auto labelled = [&](int32_t row, int w) {
    const int32_t i = row * words + w;
    return (map.level_high()[i] | map.level_low()[i]) & ~map.noted(i, task_.strict);
  };
  GridWord any = 0;
  for (int w = 0; w < words; ++w) any |= labelled(0, w) | labelled(rows - 1, w);
  for (int32_t row = 0; row < rows; ++row) {
    any |= labelled(row, 0) & 1U;
    any |= labelled(row, words - 1) >> (kWordBits - 1);
  }
  return any != 0;
}

GridWord Wavefront::passable(const GridMap& map, int32_t row, int w) const noexcept {
  const int32_t i = row * map.shape().words + w;
  const GridWord solid = task_.strict ? map.blocking()[i] : map.blocking()[i] & map.sure()[i];
  if (row == task_.body.y) return ~solid | columns(task_.body.x, task_.body.x, w);
  return ~solid;
}

bool Wavefront::blocked(const GridMap& map, Cell p) const noexcept {
  if (!map.holds(p)) return false;
  return (passable(map, p.y, static_cast<int>(p.x / kWordBits)) >> (p.x % kWordBits) & 1U) == 0;
}

int Wavefront::phase(const GridMap& map, Cell p) const noexcept {
  if (!map.holds(p)) return -1;
  const int32_t i = p.y * map.shape().words + p.x / kWordBits;
  const int32_t bit = p.x % kWordBits;
  const GridWord code = (map.level_high()[i] >> bit & 1U) * 2 + (map.level_low()[i] >> bit & 1U);
  return static_cast<int>(code) - 1;
}

/// The cells x - 1 to x + 1 of a row as its lowest three bits; those outside the window are empty.
GridWord Wavefront::three(const GridMap& map, const GridWord* plane, Cell p) noexcept {
  if (p.y < 0 || p.y >= map.shape().rows) return 0;
  const int32_t first = p.y * map.shape().words;
  const int w = static_cast<int>(p.x / kWordBits);
  const int32_t bit = p.x % kWordBits;
  const GridWord* const row = plane + first + w;
  if (bit > 0 && bit < kWordBits - 1) return *row >> (bit - 1) & 7U;
  if (bit == 0) return (*row << 1 & 6U) | (w > 0 ? row[-1] >> (kWordBits - 1) : 0);
  return (*row >> (kWordBits - 2) & 3U) | (w < map.shape().words - 1 ? (row[1] & 1U) << 2 : 0);
}

bool Wavefront::next(const GridMap& map, Cell p, Cell aim, Cell& on) const noexcept {
  const int here = phase(map, p);
  if (here < 0) return false;
  // Of the three rows around, the cells of the level below, and of this level or that.
  GridWord below[3];
  GridWord near[3];
  for (int32_t row = 0; row < 3; ++row) {
    const Cell at = p + Cell{0, row - 1};
    const GridWord high = three(map, map.level_high(), at);
    const GridWord low = three(map, map.level_low(), at);
    const auto of = [&](int n) { return (n == 0 ? ~high : high) & (n == 1 ? ~low : low); };
    below[row] = of((here + 2) % 3);
    near[row] = below[row] | of(here);
  }
  constexpr GridWord kLeft = 1, kMiddle = 2, kRight = 4;
  // Levels repeat modulo 3, so level + 2 looks the same; but then both side neighbours have level + 1.
  for (int row = 0; row < 3; row += 2) {
    const bool straight = (near[row] & kMiddle) != 0;
    if (!straight || (near[1] & kLeft) == 0) below[row] &= ~kLeft;
    if (!straight || (near[1] & kRight) == 0) below[row] &= ~kRight;
  }
  // Of the squared distances from the aim, what differs.
  const Cell rest = aim - p;
  int32_t best = INT32_MAX;
  for (int32_t y = -1; y <= 1; ++y) {
    for (int32_t x = -1; x <= 1; ++x) {
      if ((below[y + 1] >> (x + 1) & 1U) == 0) continue;
      const int32_t far = x * x + y * y - 2 * (rest.x * x + rest.y * y);
      if (far >= best) continue;
      best = far;
      on = p + Cell{x, y};
    }
  }
  return best != INT32_MAX;
}

}  // namespace whisker::planning
