#include "firmware/map/flood.hpp"

namespace whisker::map {
namespace {

constexpr int32_t kBeyond = 6;   // levels past the body's, for the cells around it
constexpr int32_t kDetour = 20;  // levels: what a way around outside the window costs more

int32_t absolute(int32_t x) noexcept { return x < 0 ? -x : x; }

/// Half the width of the row that lies dy from the goal within so many levels of it; negative: none.
int32_t half_width(int32_t level, int32_t dy) noexcept {
  const int32_t rest = level + level / 2 - absolute(dy);
  if (absolute(dy) > level) return -1;
  return rest < level ? rest : level;
}

int32_t gap(int32_t x, int32_t size) noexcept { return x < 0 ? -x : x >= size ? x - size + 1 : 0; }

}  // namespace

int32_t distance(Place d) noexcept {
  const int32_t x = absolute(d.x);
  const int32_t y = absolute(d.y);
  const int32_t longer = x > y ? x : y;
  const int32_t both = (2 * (x + y) + 2) / 3;
  return longer > both ? longer : both;
}

int32_t Flood::farthest(const Map& map) const noexcept {
  const int32_t columns = map.shape().columns() - 1;
  const int32_t rows = map.shape().rows - 1;
  const Place& g = task_.goal;
  const int32_t x = absolute(g.x) > absolute(columns - g.x) ? g.x : columns - g.x;
  const int32_t y = absolute(g.y) > absolute(rows - g.y) ? g.y : rows - g.y;
  return distance({x, y}) + detour_;
}

void Flood::begin(Map& map, const Task& task) noexcept {
  *this = Flood{};
  task_ = task;
  over_ = false;
  for (int32_t i = 0; i < 2 * map.shape().size(); ++i) map.level_high()[i] = 0;
  if (map.holds(task.goal)) {
    const int32_t i = task.goal.y * map.shape().words + task.goal.x / kWordBits;
    map.level_low()[i] |= Word{1} << (task.goal.x % kWordBits);
    low_ = high_ = task.goal.y;
    if (task.goal == task.body) reached_ = 0;
    level_ = 1;
  } else {
    entry_ = Entry::facing_border;
    level_ = distance({gap(task.goal.x, map.shape().columns()), gap(task.goal.y, map.shape().rows)});
  }
  begin_level(map);
}

void Flood::begin_level(const Map& map) noexcept {
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

bool Flood::end_level(Map& map) noexcept {
  low_ = new_low_;
  high_ = new_high_;
  const bool pending = entry_ != Entry::goal && level_ < farthest(map);
  if (reached_ < 0 && phase(map, task_.body) == level_ % 3) reached_ = level_;
  if (reached_ >= 0 && level_ >= reached_ + kBeyond) return true;
  if (level_ >= task_.most) return true;
  if (high_ < 0 && !pending) {
    if (reached_ >= 0 || entry_ == Entry::any_border || !reaches_border(map)) return true;
    // Perhaps there is a way around outside.
    entry_ = Entry::any_border;
    const int32_t inside =
        distance({gap(task_.goal.x, map.shape().columns()), gap(task_.goal.y, map.shape().rows)});
    detour_ = level_ - inside > kDetour ? level_ - inside : kDetour;
    level_ = inside + detour_ - 1;
  }
  ++level_;
  begin_level(map);
  return false;
}

bool Flood::reaches_border(const Map& map) const noexcept {
  const int words = map.shape().words;
  const int32_t rows = map.shape().rows;
  const auto labelled = [&](int32_t row, int w) {
    return map.level_high()[row * words + w] | map.level_low()[row * words + w];
  };
  Word any = 0;
  for (int w = 0; w < words; ++w) any |= labelled(0, w) | labelled(rows - 1, w);
  for (int32_t row = 0; row < rows; ++row) {
    any |= labelled(row, 0) & 1U;
    any |= labelled(row, words - 1) >> (kWordBits - 1);
  }
  return any != 0;
}

bool Flood::run(Map& map, int32_t words) noexcept {
  while (!over_ && words > 0) {
    if (row_ <= last_) {
      spread(map, row_++);
      words -= map.shape().words;
    } else {
      over_ = end_level(map);
      --words;
    }
  }
  return over_;
}

Word Flood::passable(const Map& map, int32_t row, int w) const noexcept {
  const int32_t i = row * map.shape().words + w;
  const Word solid = task_.suspects_block ? map.blocking()[i] : map.blocking()[i] & map.sure()[i];
  if (row == task_.body.y) return ~solid | columns(task_.body.x, task_.body.x, w);
  return ~solid;
}

Word Flood::front(const Map& map, int32_t row, int w) const noexcept {
  const int32_t i = row * map.shape().words + w;
  const Word high = map.level_high()[i];
  const Word low = map.level_low()[i];
  switch ((level_ + 2) % 3) {
    case 0: return low & ~high;
    case 1: return high & ~low;
    default: return high & low;
  }
}

Word Flood::entering(const Map& map, int32_t row, int w) const noexcept {
  const int32_t half = half_width(level_ - detour_, row - task_.goal.y);
  if (half < 0) return 0;
  const Word near = columns(task_.goal.x - half, task_.goal.x + half, w);
  const int32_t right = map.shape().columns() - 1;
  const bool any = entry_ == Entry::any_border;
  Word border = 0;
  if (row == 0 && (any || task_.goal.y < 0)) border = ~Word{0};
  if (row == map.shape().rows - 1 && (any || task_.goal.y >= map.shape().rows)) border = ~Word{0};
  if (any || task_.goal.x < 0) border |= columns(0, 0, w);
  if (any || task_.goal.x > right) border |= columns(right, right, w);
  return near & border;
}

/// A row's words, with none on either side.
struct Flood::Line {
  Word at[kMostWords + 2] = {};
  Word from_left(int w) const noexcept { return at[w + 1] << 1 | at[w] >> (kWordBits - 1); }
  Word from_right(int w) const noexcept { return at[w + 1] >> 1 | at[w + 2] << (kWordBits - 1); }
};

void Flood::spread(Map& map, int32_t row) noexcept {
  const int words = map.shape().words;
  Line fronts[3];
  Word any = 0;
  for (int k = 0; k < 3; ++k) {
    const int32_t r = row + k - 1;
    if (r < 0 || r >= map.shape().rows) continue;
    for (int w = 0; w < words; ++w) any |= fronts[k].at[w + 1] = front(map, r, w);
  }
  const bool enters = entry_ != Entry::goal;
  if (any == 0 && !enters) return;
  const bool diagonal = level_ % 2 == 0;
  Line opens[3];
  for (int k = diagonal ? 0 : 1; k < (diagonal ? 3 : 2); ++k) {
    const int32_t r = row + k - 1;
    if (r < 0 || r >= map.shape().rows) continue;
    for (int w = 0; w < words; ++w) opens[k].at[w + 1] = passable(map, r, w);
  }
  const Line& front_here = fronts[1];
  const Line& open_here = opens[1];
  for (int w = 0; w < words; ++w) {
    const int32_t i = row * words + w;
    const Word open = open_here.at[w + 1] & ~(map.level_high()[i] | map.level_low()[i]);
    if (open == 0) continue;
    Word news =
        front_here.from_left(w) | front_here.from_right(w) | fronts[0].at[w + 1] | fronts[2].at[w + 1];
    if (diagonal) {
      const Word left = open_here.from_left(w);
      const Word right = open_here.from_right(w);
      for (int k = 0; k < 3; k += 2) {
        const Word beside = opens[k].at[w + 1];
        news |= ((fronts[k].from_left(w) & left) | (fronts[k].from_right(w) & right)) & beside;
      }
    }
    if (enters) news |= entering(map, row, w);
    news &= open;
    if (news == 0) continue;
    if (row < new_low_) new_low_ = row;
    new_high_ = row;
    const int phase = level_ % 3;
    if (phase != 0) map.level_high()[i] |= news;
    if (phase != 1) map.level_low()[i] |= news;
  }
}

bool Flood::blocked(const Map& map, Place p) const noexcept {
  if (!map.holds(p)) return false;
  return (passable(map, p.y, static_cast<int>(p.x / kWordBits)) >> (p.x % kWordBits) & 1U) == 0;
}

int Flood::phase(const Map& map, Place p) const noexcept {
  if (!map.holds(p)) return -1;
  const int32_t i = p.y * map.shape().words + p.x / kWordBits;
  const int32_t bit = p.x % kWordBits;
  const Word code = (map.level_high()[i] >> bit & 1U) * 2 + (map.level_low()[i] >> bit & 1U);
  return static_cast<int>(code) - 1;
}

bool Flood::next(const Map& map, Place p, Place aim, Place& on) const noexcept {
  const int here = phase(map, p);
  if (here < 0) return false;
  const int nearer = (here + 2) % 3;
  int64_t best = INT64_MAX;
  for (int32_t dy = -1; dy <= 1; ++dy) {
    for (int32_t dx = -1; dx <= 1; ++dx) {
      const Place q = p + Place{dx, dy};
      if (phase(map, q) != nearer) continue;
      if (dx != 0 && dy != 0) {
        // Two levels on is the same, modulo 3: but then what lies beside both is one level on.
        const int a = phase(map, p + Place{dx, 0});
        const int b = phase(map, p + Place{0, dy});
        const auto near = [&](int n) { return n == here || n == nearer; };
        if (!near(a) || !near(b)) continue;
      }
      const Place rest = aim - q;
      const int64_t far = int64_t{rest.x} * rest.x + int64_t{rest.y} * rest.y;
      if (far < best) {
        best = far;
        on = q;
      }
    }
  }
  return best != INT64_MAX;
}

}  // namespace whisker::map
