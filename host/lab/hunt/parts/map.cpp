// The marks of beams in the planner's map, against the true geometry of each cell, and its window.
#include <algorithm>
#include <cmath>

#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/parts.hpp"
#include "host/lab/hunt/parts/room.hpp"

namespace whisker::hunt {
namespace {

using planning::Cell;
using planning::CellState;

constexpr double kSuspectHalf_deg = 6, kNarrow_deg = 4, kFar_m = 2, kSure_m = 0.16;
constexpr double kCovers = 23.0 / 32;  // cells: a disc around the centre that covers the cell
constexpr double kDegree = sim::kPi / 180;

double metres(Length l) { return l.raw() * 1e-6; }
sim::Vec2 vec(Vec v) { return {metres(v.x), metres(v.y)}; }

/// A sector, in cells.
struct Sector {
  sim::Vec2 apex;
  double axis, half;
  /// How far this point lies inside both edges.
  double inside_by(sim::Vec2 p, double half_angle) const {
    const sim::Vec2 d = p - apex;
    const double left = d.x * std::sin(axis + half_angle) - d.y * std::cos(axis + half_angle);
    const double right = -d.x * std::sin(axis - half_angle) + d.y * std::cos(axis - half_angle);
    return std::min(left, right);
  }
  double from(sim::Vec2 p) const { return std::hypot(p.x - apex.x, p.y - apex.y); }
};

perception::ConeObservation draw_observation(Dice& dice, const Room& room) {
  perception::ConeObservation seen;
  const planning::GridShape& shape = room.map.shape();
  const Vec middle = room.map.middle(draw_cell(dice, shape));
  const auto off = [&] {
    return Length::from_raw(dice.index(room.map.cell().raw()) - room.map.cell().raw() / 2);
  };
  seen.beam.apex = {middle.x + off(), middle.y + off()};
  seen.beam.axis = dice.chance(0.3) ? Angle::turns(dice.index(8), 8)
                                    : Angle::from_raw(static_cast<std::uint32_t>(dice.bits()));
  seen.beam.half_cone = Angle::turns(dice.chance(0.2) ? 10 + dice.index(60) : 60 + dice.index(240), 3600);
  seen.free = millimetres(dice.chance(0.2) ? dice.index(300) : dice.index(2600));
  seen.hit = dice.chance(0.5);
  return seen;
}

/// What a mark without doubts did to one cell.
std::string judge_cell(const Sector& sector, sim::Vec2 at, double seen, double distance, bool echo,
                       CellState before, CellState after) {
  constexpr double kSlack = 0.06;  // cells: roundings to grid units and of edges over the longest distance
  const double from = sector.from(at);
  const double across = sector.half < kNarrow_deg * kDegree ? 0 : kCovers;
  const double empty_by = std::min(sector.inside_by(at, sector.half) - across, seen - kCovers - from);
  const double core = echo ? std::min(sector.half, kSuspectHalf_deg * kDegree) : 0;
  const double off_arc = 0.5 - std::fabs(from - distance);
  const double edge = 0.02 + 0.002 * from;
  const bool ahead = std::fabs(from) > 0.7;
  if (empty_by > kSlack + edge && after != CellState::free) return "ground seen empty is not free";
  const bool freed = after == CellState::free && before != CellState::free;
  if (freed && empty_by < -kSlack - edge) return "ground not seen empty is free";
  const bool blocked = after >= CellState::suspect && after != before;
  if (blocked && !echo) return "ground is blocked without an echo";
  const double widest = std::max(sector.half, kSuspectHalf_deg * kDegree);
  if (blocked && (off_arc < -kSlack || (ahead && sector.inside_by(at, widest) < -kSlack - edge))) {
    return "ground is blocked beside the echo";
  }
  const bool untouched =
      empty_by < -0.5 && (!echo || off_arc < -0.5 || (ahead && sector.inside_by(at, widest) < -1));
  if (untouched && after != before) return "ground beside the beam changes";
  const bool must_block = echo && off_arc > kSlack && ahead && sector.inside_by(at, core) > kSlack + edge;
  if (must_block && before != CellState::free && empty_by < -kSlack && after < CellState::suspect) {
    return "ground at the echo does not block";
  }
  return "";
}

}  // namespace

std::string judge_map(Dice& dice) {
  const planning::GridShape shape = draw_shape(dice);
  Room room(shape, {}, {});
  room.scatter(dice, dice.uniform(0, 0.1), dice.uniform(0, 0.3));
  const double cell = metres(room.map.cell());
  for (int i = 0; i < 6; ++i) {
    const perception::ConeObservation seen = draw_observation(dice, room);
    std::vector<CellState> before;
    room.each([&](Cell p) { before.push_back(room.map.at(p)); });
    room.map.mark(seen);
    const sim::Vec2 apex = vec(seen.beam.apex) * (1 / cell);
    const Sector sector{apex, radians(seen.beam.axis), radians(seen.beam.half_cone)};
    const double distance = metres(seen.free) / cell, far = kFar_m / cell;
    const bool echo = seen.hit && distance < far;
    std::string wrong;
    bool any_sure = false;
    sim::Vec2 low{1e9, 1e9}, high{-1e9, -1e9};
    std::size_t n = 0;
    room.each([&](Cell p) {
      const sim::Vec2 at = vec(room.map.middle(p)) * (1 / cell);
      const CellState then = before[n++], now = room.map.at(p);
      const std::string other = judge_cell(sector, at, std::min(distance, far), distance,
                                           echo && std::fabs(distance - far) > 0.1, then, now);
      if (std::fabs(distance - far) > 0.1 && !other.empty()) wrong = other;
      any_sure = any_sure || (now == CellState::occupied && then != now);
      const bool on_arc =
          std::fabs(sector.from(at) - distance) < 0.4 && sector.inside_by(at, sector.half) > 0.1;
      if (!on_arc || then == CellState::free) return;
      low = {std::min(low.x, at.x), std::min(low.y, at.y)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    });
    if (!wrong.empty()) return wrong;
    // An echo that may have come from a wide area is not sure of any cell.
    const double wide = std::hypot(high.x - low.x, high.y - low.y) * cell;
    if (echo && high.x >= low.x && wide > kSure_m + 0.01 && any_sure) return "an echo from afar is sure";
  }
  return "";
}

namespace {

std::string judge_window(Dice& dice, Room& room) {
  const planning::GridShape& shape = room.map.shape();
  std::vector<CellState> before;
  room.each([&](Cell p) { before.push_back(room.map.at(p)); });
  const Cell corner = room.map.corner();
  const Vec body = room.map.middle(draw_cell(dice, shape, 60)),
            goal = room.map.middle(draw_cell(dice, shape, 200));
  const Cell at = room.map.place(body);
  const double x = static_cast<double>(at.x) / shape.columns(), y = static_cast<double>(at.y) / shape.rows;
  const bool moved = room.map.follow(body, goal);
  const bool near_rim =
      std::min({x, y, 1 - x, 1 - y})<0.05, well_inside = std::min({x, y, 1 - x, 1 - y})> 0.2;
  if (well_inside && moved) return "the window moves without need";
  const Cell step = room.map.corner() - corner;
  if (moved != (step != Cell{})) return "a move that is none";
  const Cell now = room.map.place(body);
  if (!room.map.holds(now)) return "the window loses the body";
  if (near_rim && moved) {
    const int low_x = shape.columns() / 6, low_y = shape.rows / 6;
    if (now.x < low_x || now.y < low_y || now.x >= shape.columns() - low_x || now.y >= shape.rows - low_y) {
      return "the body is near the rim of the moved window";
    }
    const Cell to = room.map.place(goal);
    const auto leans = [](int body_at, int goal_at, int size) {
      const int far = goal_at - body_at;
      return std::abs(far) < 4 || (far > 0 ? body_at <= size / 2 : body_at >= size / 2 - 1);
    };
    if (!leans(now.x, to.x, shape.columns()) || !leans(now.y, to.y, shape.rows))
      return "it leans away from the goal";
    const bool fits =
        std::abs(to.x - now.x) < shape.columns() / 2 - 1 && std::abs(to.y - now.y) < shape.rows / 2 - 1;
    if (fits && !room.map.holds(to)) return "a goal that fits is left out";
  }
  std::string wrong;
  room.each([&](Cell p) {
    const Cell old = p + step;
    const CellState due = room.map.holds(old) ? before[room.index(old)] : CellState::unknown;
    if (room.map.at(p) != due) wrong = "a moved cell changes";
    if (room.map.place(room.map.middle(p)) != p) wrong = "a cell is not where its middle is";
  });
  return wrong;
}

/// While a plan is made, what it has reached stays blocked, and cells far from it open.
std::string judge_hold(Dice& dice) {
  Room room(draw_shape(dice), {}, {});
  const planning::GridShape& shape = room.map.shape();
  room.scatter(dice, 0.3, 0);
  const Cell level = draw_cell(dice, shape);
  planning::GridWord* const plane = dice.chance(0.5) ? room.map.level_low() : room.map.level_high();
  plane[level.y * shape.words + level.x / planning::kWordBits] |= planning::GridWord{1}
                                                                  << (level.x % planning::kWordBits);
  std::vector<CellState> before;
  room.each([&](Cell p) { before.push_back(room.map.at(p)); });
  Room open(shape, {}, {});
  open.storage = room.storage;
  perception::ConeObservation seen = draw_observation(dice, room);
  seen.hit = false;
  const planning::GridMap::Hold hold{{-1, -1}, {-1, -1}, true};
  room.map.mark(seen, &hold);
  open.map.mark(seen);
  std::string wrong;
  room.each([&](Cell p) {
    const CellState then = before[room.index(p)];
    const bool closed = then >= CellState::suspect;
    const bool rim = p.x == 0 || p.y == 0 || p.x == shape.columns() - 1 || p.y == shape.rows - 1;
    const bool near = std::abs(p.x - level.x) <= 1 && std::abs(p.y - level.y) <= 1;
    const CellState due = closed && (near || rim) ? then : open.map.at(p);
    // A cell that is noted to be free holds those beside it, too.
    bool may_stay = false;
    for (int y = -1; y <= 1 && room.map.at(p) == then; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const Cell q = p + Cell{x, y};
        may_stay = may_stay || (!(q == p) && room.blocks(q) && !open.blocks(q));
      }
    }
    if (room.map.at(p) != due && !may_stay) wrong = "a plan holds another cell";
  });
  room.map.release(hold);
  room.each([&](Cell p) {
    const bool freed = before[room.index(p)] >= CellState::suspect && !open.blocks(p);
    if (freed && room.blocks(p)) wrong = "a cell stays shut when the plan is over";
  });
  room.map.doubt_all();
  room.each([&](Cell p) {
    const CellState now = room.map.at(p);
    if (now != CellState::free && now != CellState::unknown) wrong = "doubt leaves a blocked cell";
  });
  return wrong;
}

}  // namespace

std::string judge_map_window(Dice& dice) {
  Room room(draw_shape(dice), {}, {});
  for (int i = 0; i < 20; ++i) {
    const Cell p = draw_cell(dice, room.map.shape());
    const auto state = static_cast<CellState>(dice.index(4));
    room.map.set(p, state);
    if (room.map.at(p) != state) return "a cell is not what it was set to";
  }
  room.scatter(dice, 0.3, 0.2);
  for (int i = 0; i < 8; ++i) {
    const std::string wrong = judge_window(dice, room);
    if (!wrong.empty()) return wrong;
  }
  return judge_hold(dice);
}

}  // namespace whisker::hunt
