#include "firmware/planning/global/grid_map.hpp"

namespace whisker::planning {
namespace {

using perception::floor_div;
using perception::kHalfCell;
using perception::kUnitsPerCell;

constexpr int32_t kInside =
    perception::kUnitsPerCell * 23 / 32;  // a disc of this radius around a cell's centre covers the cell
constexpr Length kFar = 2_m;              // for the reference body
constexpr Length kSure = 160_mm;          // across: an echo from an area this small has a single origin
constexpr Angle kSuspectHalf = 6_deg;
constexpr Angle kNarrow = 4_deg;
constexpr int32_t kNearBorder = 9;            // a ninth of the window
constexpr int32_t kBias = 10, kBiasPart = 3;  // the body is at most 3/10 of the window off its centre

struct Columns {
  int32_t first;
  int32_t last;
};

/// The columns whose centres lie within the span.
Columns within(const perception::Span& span) noexcept {
  // So far to the left, no span begins: the quotients of positive numbers are shifts.
  constexpr int32_t kLeft = 1 << 20;
  const auto cell = [](int32_t x) {
    return narrow<int32_t>(narrow<uint32_t>(x + kLeft * kUnitsPerCell) / kUnitsPerCell) - kLeft;
  };
  return {cell(span.low + kUnitsPerCell - 1 - kHalfCell), cell(span.high - kHalfCell)};
}

/// Calls each(w, cells) for the words with cells of these columns.
template <class F>
void each_word(Columns c, const GridShape& shape, F&& each) {
  const int32_t low = c.first < 0 ? 0 : c.first;
  const int32_t high = c.last < shape.columns() ? c.last : shape.columns() - 1;
  if (low > high) return;
  const int last = static_cast<int>(high / kWordBits);
  for (int w = static_cast<int>(low / kWordBits); w <= last; ++w) each(w, columns(low, high, w));
}

int32_t clamped(int32_t x, int32_t most) noexcept { return x > most ? most : x < -most ? -most : x; }

}  // namespace

/// Bounding box of the cells that may have caused an echo.
struct GridMap::Box {
  Cell low{INT16_MAX, INT16_MAX};
  Cell high{-1, -1};
  bool empty() const noexcept { return high.x < low.x; }
  void add(int32_t x, int32_t y) noexcept {
    if (x < low.x) low.x = x;
    if (x > high.x) high.x = x;
    if (y < low.y) low.y = y;
    if (y > high.y) high.y = y;
  }
};

int32_t GridMap::units(Length l) const noexcept {
  return saturate32(floor_div(signed_product(l.raw(), kUnitsPerCell), cell_um_));
}

void GridMap::configure(const Params& params) noexcept {
  cell_um_ = for_body(params, shape_.cell).raw();
  far_ = units(for_body(params, kFar));
}

Cell GridMap::place(Vec at) const noexcept {
  return Cell{static_cast<int32_t>(floor_div(int64_t{at.x.raw()}, cell_um_)),
              static_cast<int32_t>(floor_div(int64_t{at.y.raw()}, cell_um_))} -
         corner_;
}

Vec GridMap::middle(Cell p) const noexcept {
  const auto at = [this](int32_t n) {
    return Length::from_raw(saturate32(signed_product(n, cell_um_) + cell_um_ / 2));
  };
  const Cell world = p + corner_;
  return {at(world.x), at(world.y)};
}

Cell GridMap::corner_for(Vec body, Vec goal) const noexcept {
  const Cell at = place(body) + corner_;
  const Cell to = place(goal) + corner_ - at;
  const int32_t columns = shape_.columns();
  const int32_t rows = shape_.rows;
  return {at.x + clamped(to.x / 2, columns * kBiasPart / kBias) - columns / 2,
          at.y + clamped(to.y / 2, rows * kBiasPart / kBias) - rows / 2};
}

void GridMap::reset(Vec body, Vec goal) noexcept {
  for (int32_t i = 0; i < kGridPlanes * shape_.size(); ++i) planes_[i] = 0;
  notes_ = false;
  corner_ = corner_for(body, goal);
}

bool GridMap::follow(Vec body, Vec goal) noexcept {
  const Cell p = place(body);
  const int32_t x = shape_.columns() / kNearBorder;
  const int32_t y = shape_.rows / kNearBorder;
  if (p.x >= x && p.y >= y && p.x < shape_.columns() - x && p.y < shape_.rows - y) return false;
  const Cell step = corner_for(body, goal) - corner_;
  if (step == Cell{}) return false;
  move_by(step);
  return true;
}

void GridMap::move_by(Cell step) noexcept {
  const int32_t words = shape_.words;
  corner_ = corner_ + step;
  const int32_t skip = floor_div(step.x, kWordBits);
  const int32_t shift = step.x - skip * kWordBits;
  GridWord* const kept[] = {blocking(), sure()};
  for (GridWord* const cells : kept) {
    for (int32_t i = 0; i < shape_.rows; ++i) {
      const int32_t row = step.y >= 0 ? i : shape_.rows - 1 - i;
      const int32_t from = row + step.y;
      for (int32_t j = 0; j < words; ++j) {
        const int32_t w = step.x >= 0 ? j : words - 1 - j;
        const auto old = [&](int32_t n) {
          return from < 0 || from >= shape_.rows || n < 0 || n >= words ? GridWord{0}
                                                                        : cells[from * words + n];
        };
        const GridWord low = old(w + skip) >> shift;
        const GridWord high = shift == 0 ? 0 : old(w + skip + 1) << (kWordBits - shift);
        cells[row * words + w] = low | high;
      }
    }
  }
}

CellState GridMap::at(Cell p) const noexcept {
  const int32_t i = p.y * shape_.words + p.x / kWordBits;
  const int32_t bit = p.x % kWordBits;
  return static_cast<CellState>(((blocking()[i] >> bit) & 1U) * 2 + ((sure()[i] >> bit) & 1U));
}

void GridMap::set(Cell p, CellState state) noexcept {
  if (!holds(p)) return;
  const int32_t i = p.y * shape_.words + p.x / kWordBits;
  const GridWord bit = GridWord{1} << (p.x % kWordBits);
  const int n = static_cast<int>(state);
  blocking()[i] = (n & 2) != 0 ? blocking()[i] | bit : blocking()[i] & ~bit;
  sure()[i] = (n & 1) != 0 ? sure()[i] | bit : sure()[i] & ~bit;
}

void GridMap::doubt_all() noexcept {
  for (int32_t i = 0; i < shape_.size(); ++i) {
    sure()[i] &= ~blocking()[i];
    blocking()[i] = 0;
  }
}

int32_t GridMap::reach_of(const perception::LocalGrid& local_grid) const noexcept {
  return local_grid.half_window().raw() / cell_um_;
}

void GridMap::free(const perception::LocalGrid& local_grid, Vec body, int32_t row) noexcept {
  const Length radius = Length::from_raw(cell_um_ / 5 * 3);
  const int32_t reach = reach_of(local_grid);
  const Cell at = place(body);
  for (int32_t x = at.x - reach; x <= at.x + reach; ++x) {
    const Cell p{x, at.y + row};
    if (local_grid.all_clear(middle(p), radius)) set(p, CellState::free);
  }
}

/// Cells of walls that a beam meets at more than 45 degrees from the normal. A wall is a run of blocked
/// cells.
GridWord GridMap::oblique(int32_t row, int w, bool upright) const noexcept {
  const int32_t words = shape_.words;
  const int32_t i = row * words + w;
  const GridWord* const here = blocking() + i;
  const GridWord across = beside(w > 0 ? here[-1] : 0, *here, w < words - 1 ? here[1] : 0);
  const GridWord along = (row > 0 ? here[-words] : 0) | (row < shape_.rows - 1 ? here[words] : 0);
  return *here & sure()[i] & (upright ? along & ~across : across & ~along);
}

GridWord GridMap::held(int32_t row, int w, const Hold& hold, GridWord cells) noexcept {
  const int32_t i = row * shape_.words + w;
  cells &= blocking()[i] & (hold.strict ? ~GridWord{0} : sure()[i]);
  if (cells == 0) return 0;
  cells &= touched(row, w);
  // A cell that blocks has no level, so its bits can say that it is free.
  const GridWord news = cells & ~own(hold, row, w) & ~level_high()[i];
  level_low()[i] |= news;
  notes_ = notes_ || news != 0;
  return cells;
}

/// The wavefront's own cells of a word, which have a level whatever stands there.
GridWord GridMap::own(const Hold& hold, int32_t row, int w) noexcept {
  GridWord cells = row == hold.body.y ? columns(hold.body.x, hold.body.x, w) : 0;
  if (row == hold.goal.y) cells |= columns(hold.goal.x, hold.goal.x, w);
  return cells;
}

void GridMap::release(const Hold& hold) noexcept {
  if (!notes_) return;
  notes_ = false;
  for (int32_t i = 0; i < size_; ++i) {
    GridWord cells = noted(i, hold.strict);
    if (cells == 0) continue;
    cells &= ~own(hold, i / shape_.words, static_cast<int>(i % shape_.words));
    sure()[i] |= cells;
    blocking()[i] &= ~cells;
    level_high()[i] &= ~cells;
    level_low()[i] &= ~cells;
  }
}

/// Only these cells can affect the current plan: cells with a level, their neighbours, and the window's rim,
/// where a path may enter.
GridWord GridMap::touched(int32_t row, int w) const noexcept {
  const int32_t words = shape_.words;
  if (row == 0 || row == shape_.rows - 1) return ~GridWord{0};
  GridWord near = 0;
  const GridWord* const high = level_high();
  const GridWord* const low = level_low();
  for (int32_t i = (row - 1) * words + w; i <= (row + 1) * words + w; i += words) {
    const auto levels = [&](int32_t at) { return high[at] | low[at]; };
    const GridWord left = w == 0 ? ~GridWord{0} : levels(i - 1);
    const GridWord here = levels(i);
    const GridWord right = w == words - 1 ? ~GridWord{0} : levels(i + 1);
    near |= here | beside(left, here, right);
  }
  return near;
}

int32_t GridMap::mark(const perception::ConeObservation& observation, const Hold* hold,
                      bool doubts) noexcept {
  const perception::Beam& beam = observation.beam;
  const auto from_corner = [this](Length x, int32_t corner) {
    return saturate32(
        floor_div((int64_t{x.raw()} - signed_product(corner, cell_um_)) * kUnitsPerCell, cell_um_));
  };
  const int32_t x = from_corner(beam.apex.x, corner_.x);
  const int32_t y = from_corner(beam.apex.y, corner_.y);
  if (!holds({floor_div(x, kUnitsPerCell), floor_div(y, kUnitsPerCell)})) return 0;
  const int32_t distance = units(observation.free);
  const int32_t seen = distance < far_ ? distance : far_;
  const bool echo = observation.hit && distance < far_;
  const perception::Wedge cone(beam.axis, beam.half_cone);
  const int32_t reach = echo ? distance + kHalfCell : seen - kInside;
  if (reach < 0) return 0;
  const bool within_cone = !echo || beam.half_cone.raw() >= kSuspectHalf.raw();
  const perception::Wedge::Extent extent =
      (within_cone ? cone : perception::Wedge(beam.axis, kSuspectHalf)).extent(reach);
  int32_t first = perception::ceil_div(y + extent.low - perception::kRim - kHalfCell, kUnitsPerCell);
  int32_t last = floor_div(y + extent.high + perception::kRim - kHalfCell, kUnitsPerCell);
  if (first < 0) first = 0;
  if (last > shape_.rows - 1) last = shape_.rows - 1;
  const bool upright = magnitude(beam.axis + beam.axis) > (90_deg).raw();
  // Readings of a narrow cone one after another free a cell together.
  const int32_t across = beam.half_cone.raw() < kNarrow.raw() ? 0 : kInside;
  GridWord* const sure = this->sure();
  Box box;
  bool takes_back = false;
  const int32_t begin = first * kUnitsPerCell + kHalfCell - y;
  const auto arc = [&](const perception::Wedge& wedge, auto&& each) {
    perception::WedgeCut edges = wedge.clipping(x, begin, 0);
    for (int32_t row = first; row <= last; ++row, edges.next()) {
      const int32_t dy = row * kUnitsPerCell + kHalfCell - y;
      perception::Span outer{x - reach, x + reach};
      edges.clip(outer, dy);
      if (outer.empty()) continue;
      outer.within_disc(x, dy, distance + kHalfCell);
      if (outer.empty()) continue;
      perception::Span inner{x - reach, x + reach};
      inner.within_disc(x, dy, distance - kHalfCell);
      const Columns nearer = inner.empty() ? Columns{INT16_MAX, -INT16_MAX} : within(inner);
      each_word(within(outer), shape_, [&](int w, GridWord all) {
        const int32_t i = row * shape_.words + w;
        const GridWord freed = takes_back ? 0 : sure[i] & ~planes_[i];
        const GridWord cells = all & ~columns(nearer.first, nearer.last, w) & ~freed;
        if (cells != 0) each(row, w, cells);
      });
    }
  };
  perception::WedgeCut inside = cone.clipping(x, begin, across);
  for (int32_t row = first; row <= last; ++row, inside.next()) {
    const int32_t dy = row * kUnitsPerCell + kHalfCell - y;
    perception::Span empty{x - reach, x + reach};
    inside.clip(empty, dy);
    if (empty.empty()) continue;
    empty.within_disc(x, dy, seen - kInside);
    if (empty.empty()) continue;
    each_word(within(empty), shape_, [&](int w, GridWord cells) {
      const int32_t i = row * shape_.words + w;
      if (doubts) cells &= ~oblique(row, w, upright);
      if (hold != nullptr) cells &= ~held(row, w, *hold, cells);
      sure[i] |= cells;
      planes_[i] &= ~cells;
    });
  }
  const int32_t rows = last < first ? 0 : last - first + 1;
  if (!echo) return rows;
  const auto find = [&] {
    arc(cone, [&](int32_t row, int w, GridWord cells) {
      int32_t column = w * kWordBits;
      for (; cells != 0; cells >>= 1, ++column) {
        if ((cells & 1U) != 0) box.add(column, row);
      }
    });
  };
  find();
  if (doubts && box.empty()) {
    takes_back = true;
    find();
  }
  const Cell wide = box.high - box.low;
  const int32_t most = units(kSure) * kUnitsPerCell;
  const bool narrow = !box.empty() && wide.x < kWordBits && wide.y < kWordBits &&
                      (wide.x * wide.x + wide.y * wide.y) * kUnitsPerCell * kUnitsPerCell <=
                          most / kUnitsPerCell * (most / kUnitsPerCell);
  if (box.empty() && within_cone) return rows * 3;
  arc(narrow ? cone : perception::Wedge(beam.axis, kSuspectHalf), [&](int32_t row, int w, GridWord cells) {
    const int32_t i = row * shape_.words + w;
    const GridWord news = narrow ? cells : cells & ~planes_[i];
    planes_[i] |= news;
    sure[i] = narrow ? sure[i] | news : sure[i] & ~news;
    if (hold == nullptr || !(narrow || hold->strict)) return;
    const GridWord level = ~news | own(*hold, row, w);
    level_high()[i] &= level;
    level_low()[i] &= level;
  });
  return rows * 3;
}

}  // namespace whisker::planning
