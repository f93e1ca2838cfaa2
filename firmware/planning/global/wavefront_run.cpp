#include "firmware/planning/global/wavefront.hpp"

namespace whisker::planning {
namespace {

constexpr int32_t kLevelWords = 3;  // that the end of a level takes as long as

/// Half width of the row dy from the goal within the area that `level` levels cover; negative: none.
int32_t half_width(int32_t level, int32_t dy) noexcept {
  const int32_t rest = level + level / 2 - absolute(dy);
  if (absolute(dy) > level) return -1;
  return rest < level ? rest : level;
}

uint64_t both(const GridWord* words) noexcept { return words[0] | uint64_t{words[1]} << kWordBits; }

}  // namespace

/// The row to spread to, and the rows above and below. Each is read once per level: cells that a level adds
/// have a different phase from those it spreads from.
class Wavefront::Rows {
 public:
  Rows(Wavefront& wavefront, GridMap& map) noexcept
      : wavefront_(wavefront),
        shape_(map.shape()),
        blocking_(map.blocking()),
        sure_(map.sure()),
        high_(map.level_high()),
        low_(map.level_low()),
        any_state_(wavefront.task_.strict ? ~GridWord{0} : 0),
        body_row_(map.holds(wavefront.task_.body) ? wavefront.task_.body.y : kNone),
        goal_row_(map.holds(wavefront.task_.goal) ? wavefront.task_.goal.y : kNone),
        words_(shape_.words) {
    begin_level();
  }
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  void begin_level() noexcept;
  /// Spreads to these rows of the level.
  void spread(int32_t row, int32_t end) noexcept;

 private:
  /// The words of a row, with an empty word on either side.
  struct Row {
    GridWord front[kMostWords + 2];  ///< cells of the previous level
    GridWord open[kMostWords + 2];   ///< cells that do not block
    GridWord fresh[kMostWords + 2];  ///< open cells without a level
    GridWord any;                    ///< union of front
  };

  /// The two words of a row as one; most maps are so wide.
  struct Pair {
    uint64_t front, open, fresh;
  };

  void read(int32_t row, Row& to) const noexcept;
  void read(int32_t row, Pair& to) const noexcept;
  [[gnu::noinline]] void read_apart(int32_t row, Pair& to) const noexcept;
  [[gnu::noinline]] void stand_out(Cell at, Row& to) const noexcept;
  void spread(int32_t row, const Row& above, const Row& here, const Row& below) noexcept;
  /// Whether it adds a cell.
  bool spread(int32_t row, const Pair& above, const Pair& here, const Pair& below) noexcept;
  // Apart, so that the stack holds the rows of one of them.
  [[gnu::noinline]] void spread_pairs(int32_t row, int32_t end) noexcept;
  [[gnu::noinline]] void spread_words(int32_t row, int32_t end) noexcept;
  [[gnu::noinline]] GridWord entering(int32_t row, int w, GridWord fresh) const noexcept;
  /// In this row, open cells of a side that the wavefront enters have no level.
  bool enters(int32_t row, const Row& here) const noexcept {
    if (!enters_) return false;
    return ((here.fresh[1] & left_) | (here.fresh[words_] & right_)) != 0 || (row == 0 && top_) ||
           (row == shape_.rows - 1 && bottom_);
  }
  Wavefront& wavefront_;
  const GridShape& shape_;
  const GridWord* const blocking_;
  const GridWord* const sure_;
  GridWord* const high_;
  GridWord* const low_;
  const GridWord any_state_;            // suspected cells also block
  static constexpr int32_t kNone = -2;  // rows -1 and beyond the last are empty
  const int32_t body_row_;
  const int32_t goal_row_;
  const int words_;
  // State of the level:
  bool diagonal_ = false;
  bool enters_ = false;  // across a side of the window:
  bool top_ = false;
  bool bottom_ = false;
  GridWord left_ = 0;
  GridWord right_ = 0;
  GridWord not_high_ = 0;  // inverse of the planes' bits of the previous level
  GridWord not_low_ = 0;
  GridWord in_high_ = 0;  // the planes' bits of this level
  GridWord in_low_ = 0;
};

void Wavefront::Rows::begin_level() noexcept {
  const auto all = [](bool set) { return set ? ~GridWord{0} : GridWord{0}; };
  const int phase = wavefront_.level_ % 3;
  diagonal_ = wavefront_.level_ % 2 == 0;
  enters_ = wavefront_.entry_ != Entry::goal;
  const bool any = wavefront_.entry_ == Entry::any_border;
  const Cell& goal = wavefront_.task_.goal;
  top_ = any || goal.y < 0;
  bottom_ = any || goal.y >= shape_.rows;
  left_ = any || goal.x < 0 ? 1U : 0;
  right_ = any || goal.x >= shape_.columns() ? GridWord{1} << (kWordBits - 1) : 0;
  in_high_ = all(phase != 0);
  in_low_ = all(phase != 1);
  not_high_ = all(phase == 1);
  not_low_ = all(phase == 2);
}

inline void Wavefront::Rows::read(int32_t row, Row& to) const noexcept {
  const int words = words_;
  to.any = 0;
  if (row < 0 || row >= shape_.rows) {
    for (int w = 1; w <= words; ++w) to.front[w] = to.open[w] = to.fresh[w] = 0;
    return;
  }
  const int32_t first = row * words;
  const GridWord* const blocking = blocking_ + first;
  const GridWord* const sure = sure_ + first;
  const GridWord* const high = high_ + first;
  const GridWord* const low = low_ + first;
  const GridWord not_high = not_high_;
  const GridWord not_low = not_low_;
  const GridWord any_state = any_state_;
  GridWord any = 0;
  for (int w = 0; w < words; ++w) {
    const GridWord h = high[w];
    const GridWord l = low[w];
    const GridWord open = ~(blocking[w] & (sure[w] | any_state));
    const GridWord front = (h ^ not_high) & (l ^ not_low) & open;
    any |= front;
    to.front[w + 1] = front;
    to.open[w + 1] = open;
    to.fresh[w + 1] = open & ~(h | l);
  }
  to.any = any;
  if (row == goal_row_) stand_out(wavefront_.task_.goal, to);
  if (row == body_row_) stand_out(wavefront_.task_.body, to);
}

/// The level of this cell counts, whatever stands there, and the body's is open.
void Wavefront::Rows::stand_out(Cell at, Row& to) const noexcept {
  const int w = static_cast<int>(at.x / kWordBits);
  const int32_t i = at.y * shape_.words + w;
  const GridWord bit = GridWord{1} << (at.x % kWordBits);
  const GridWord front = (high_[i] ^ not_high_) & (low_[i] ^ not_low_) & bit;
  to.front[w + 1] |= front;
  to.any |= front;
  if (!(at == wavefront_.task_.body)) return;
  to.open[w + 1] |= bit;
  to.fresh[w + 1] |= bit & ~(high_[i] | low_[i]);
}

GridWord Wavefront::Rows::entering(int32_t row, int w, GridWord fresh) const noexcept {
  const Cell& goal = wavefront_.task_.goal;
  GridWord border = w == 0 ? left_ : 0;
  if (w == shape_.words - 1) border |= right_;
  if ((row == 0 && top_) || (row == shape_.rows - 1 && bottom_)) border = ~GridWord{0};
  if ((border & fresh) == 0) return 0;
  const int32_t half = half_width(wavefront_.level_ - wavefront_.detour_, row - goal.y);
  return border & columns(goal.x - half, goal.x + half, w);
}

/// A row in which a cell stands out.
void Wavefront::Rows::read_apart(int32_t row, Pair& to) const noexcept {
  Row apart;  // NOLINT(cppcoreguidelines-pro-type-member-init): read() fills what is taken from it
  read(row, apart);
  to = {both(apart.front + 1), both(apart.open + 1), both(apart.fresh + 1)};
}

inline void Wavefront::Rows::read(int32_t row, Pair& to) const noexcept {
  if (static_cast<uint32_t>(row) >= static_cast<uint32_t>(shape_.rows)) {
    to = {0, 0, 0};
    return;
  }
  if (row == goal_row_ || row == body_row_) {
    read_apart(row, to);
    return;
  }
  const auto twice = [](GridWord word) { return word | uint64_t{word} << kWordBits; };
  const int32_t first = 2 * row;
  const uint64_t high = both(high_ + first), low = both(low_ + first);
  const uint64_t open = ~(both(blocking_ + first) & (both(sure_ + first) | twice(any_state_)));
  to = {(high ^ twice(not_high_)) & (low ^ twice(not_low_)) & open, open, open & ~(high | low)};
}

inline bool Wavefront::Rows::spread(int32_t row, const Pair& above, const Pair& here,
                                    const Pair& below) noexcept {
  if (here.fresh == 0) return false;
  const auto beside = [](uint64_t cells) { return cells << 1 | cells >> 1; };
  uint64_t news = beside(here.front) | above.front | below.front;
  if (diagonal_) {
    news |= beside(above.front & here.open) & above.open;
    news |= beside(below.front & here.open) & below.open;
  }
  news &= here.fresh;
  if (news == 0) return false;
  for (int w = 0; w < 2; ++w) {
    const auto part = static_cast<GridWord>(news >> (w * kWordBits));
    high_[2 * row + w] |= part & in_high_;
    low_[2 * row + w] |= part & in_low_;
  }
  return true;
}

void Wavefront::Rows::spread_pairs(int32_t row, int32_t end) noexcept {
  Pair pair[3];
  Pair *above = pair, *here = pair + 1, *below = pair + 2;
  int32_t first = -1, last = -1;
  for (int32_t next = row - 1; next <= end; ++next) {
    Pair* const oldest = above;
    above = here;
    here = below;
    below = oldest;
    read(next, *below);
    if (next <= row || !spread(next - 1, *above, *here, *below)) continue;
    last = next - 1;
    if (first < 0) first = last;
  }
  if (last < 0) return;
  if (first < wavefront_.new_low_) wavefront_.new_low_ = first;
  wavefront_.new_high_ = last;
}

void Wavefront::Rows::spread(int32_t row, int32_t end) noexcept {
  words_ == 2 && !enters_ ? spread_pairs(row, end) : spread_words(row, end);
}

void Wavefront::Rows::spread_words(int32_t row, int32_t end) noexcept {
  Row rows[3];
  for (Row& r : rows) r.front[0] = r.open[0] = r.front[words_ + 1] = r.open[words_ + 1] = 0;
  Row *above = rows, *here = rows + 1, *below = rows + 2;
  for (int32_t next = row - 1; next <= end; ++next) {
    Row* const oldest = above;
    above = here;
    here = below;
    below = oldest;
    read(next, *below);
    if (next > row && ((above->any | here->any | below->any) != 0 || enters(next - 1, *here))) {
      spread(next - 1, *above, *here, *below);
    }
  }
}

inline void Wavefront::Rows::spread(int32_t row, const Row& above, const Row& here,
                                    const Row& below) noexcept {
  const bool enters = this->enters(row, here);
  for (int w = 1; w <= words_; ++w) {
    const GridWord fresh = here.fresh[w];
    if (fresh == 0) continue;
    GridWord news =
        beside(here.front[w - 1], here.front[w], here.front[w + 1]) | above.front[w] | below.front[w];
    if (diagonal_) {
      // Not across a blocked corner: only over cells that are open in both rows.
      const GridWord* const open = here.open + w;
      const GridWord* const a = above.front + w;
      const GridWord* const b = below.front + w;
      news |= beside(a[-1] & open[-1], a[0] & open[0], a[1] & open[1]) & above.open[w];
      news |= beside(b[-1] & open[-1], b[0] & open[0], b[1] & open[1]) & below.open[w];
    }
    if (enters) news |= entering(row, w - 1, fresh);
    news &= fresh;
    if (news == 0) continue;
    if (row < wavefront_.new_low_) wavefront_.new_low_ = row;
    wavefront_.new_high_ = row;
    const int32_t i = row * words_ + w - 1;
    high_[i] |= news & in_high_;
    low_[i] |= news & in_low_;
  }
}

bool Wavefront::run(GridMap& map, int32_t words, int32_t* spare) noexcept {
  Rows rows(*this, map);
  while (!over_ && words > 0) {
    if (row_ <= last_) {
      const int32_t width = map.shape().words;
      const int32_t some = (words - 1) / width + 1;
      const int32_t end = some < last_ + 1 - row_ ? row_ + some : last_ + 1;
      words -= (end - row_) * width;
      rows.spread(row_, end);
      row_ = end;
    } else {
      over_ = end_level(map);
      rows.begin_level();
      words -= kLevelWords;
    }
  }
  if (spare != nullptr) *spare = words;
  return over_;
}

}  // namespace whisker::planning
