// The wavefront by whole words of rows, against one that spreads cell by cell.
#include "firmware/planning/global/wavefront.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "host/lab/hunt/parts/parts.hpp"
#include "host/lab/hunt/parts/room.hpp"

namespace whisker::hunt {
namespace {

using planning::Cell;
using planning::CellState;
using planning::Wavefront;

constexpr int kNever = -1;
constexpr Cell kBeside[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

/// Levels of the cells that have a way to the goal inside the window, or across the border that faces it.
class Levels {
 public:
  Levels(const Room& room, const Wavefront::Task& task)
      : room_(room), task_(task), levels_(static_cast<std::size_t>(room.map.shape().size()) * 32, kNever) {
    std::vector<Cell> front;
    const bool inside = room.map.holds(task.goal);
    if (inside) take(task.goal, 0, front);
    const int last = inside ? 0 : 2 * (std::abs(task.goal.x) + std::abs(task.goal.y)) + 400;
    for (int l = 1; !front.empty() || l <= last; ++l) front = spread(front, l, inside);
  }
  int at(Cell p) const { return levels_[room_.index(p)]; }
  bool open(Cell p) const {
    if (!room_.map.holds(p)) return false;
    if (p == task_.body) return true;
    const CellState s = room_.map.at(p);
    return s != CellState::occupied && !(task_.strict && s == CellState::suspect);
  }
  /// The last step leads to the goal even if that is blocked.
  bool may_descend(Cell p, Cell way) const {
    const auto passes = [&](Cell q) { return open(q) || q == task_.goal; };
    return passes(p + way) &&
           (way.x == 0 || way.y == 0 || (passes(p + Cell{way.x, 0}) && passes(p + Cell{0, way.y})));
  }
  /// A step to a neighbour does not cross the corner of a blocked cell.
  bool may_step(Cell p, Cell way) const {
    return open(p + way) &&
           (way.x == 0 || way.y == 0 || (open(p + Cell{way.x, 0}) && open(p + Cell{0, way.y})));
  }
  bool is_rim(Cell p) const {
    const planning::GridShape& s = room_.map.shape();
    return p.x == 0 || p.y == 0 || p.x == s.columns() - 1 || p.y == s.rows - 1;
  }
  /// The cells that have a way to this one include a cell of the rim.
  bool has_way_out(Cell from) const {
    std::vector<bool> seen(levels_.size());
    std::vector<Cell> stack = {from};
    seen[room_.index(from)] = true;
    while (!stack.empty()) {
      const Cell p = stack.back();
      stack.pop_back();
      if (is_rim(p)) return true;
      for (const Cell way : kBeside) {
        if (!may_step(p, way) || seen[room_.index(p + way)]) continue;
        seen[room_.index(p + way)] = true;
        stack.push_back(p + way);
      }
    }
    return false;
  }

 private:
  void take(Cell p, int level, std::vector<Cell>& to) {
    levels_[room_.index(p)] = level;
    to.push_back(p);
  }
  bool faces(Cell p) const {
    const Cell g = task_.goal;
    const planning::GridShape& s = room_.map.shape();
    return (p.x == 0 && g.x < 0) || (p.y == 0 && g.y < 0) || (p.x == s.columns() - 1 && g.x >= s.columns()) ||
           (p.y == s.rows - 1 && g.y >= s.rows);
  }
  std::vector<Cell> spread(const std::vector<Cell>& front, int l, bool inside) {
    std::vector<Cell> next;
    for (const Cell p : front) {
      for (const Cell way : kBeside) {
        const bool diagonal = way.x != 0 && way.y != 0;
        if ((diagonal && l % 2 != 0) || !may_step(p, way) || at(p + way) != kNever) continue;
        take(p + way, l, next);
      }
    }
    if (inside) return next;
    room_.each([&](Cell p) {
      if (!faces(p) || !open(p) || at(p) != kNever) return;
      const int dx = std::abs(p.x - task_.goal.x), dy = std::abs(p.y - task_.goal.y);
      if (std::max(dx, dy) <= l && dx + dy <= l + l / 2) take(p, l, next);
    });
    return next;
  }

  const Room& room_;
  const Wavefront::Task& task_;
  std::vector<int> levels_;
};

std::string judge_levels(const Room& room, const Levels& levels, const Wavefront& wavefront, int most) {
  std::string wrong;
  room.each([&](Cell p) {
    const int level = levels.at(p);
    const bool due = level != kNever && level <= std::min(most, wavefront.levels());
    if (wavefront.phase(room.map, p) != (due ? level % 3 : kNever)) wrong = "a cell has another level";
    if (wavefront.blocked(room.map, p) == levels.open(p)) wrong = "blocked and open at once";
  });
  return wrong;
}

/// Down to the goal, or to where the way leaves the window.
std::string judge_descent(const Room& room, const Levels& levels, const Wavefront& wavefront,
                          const Wavefront::Task& task) {
  const int here = levels.at(task.body);
  Cell p = task.body, on;
  int left = wavefront.level();
  for (; wavefront.next(room.map, p, task.goal, on); p = on, --left) {
    if (left <= 0) return "a descent longer than its level";
    const Cell way = on - p;
    if (std::abs(way.x) > 1 || std::abs(way.y) > 1 || !levels.may_descend(p, way))
      return "a step over a corner";
    if (here == kNever) continue;
    if (levels.at(on) != levels.at(p) - 1) return "a step that is no descent";
    for (const Cell other : kBeside) {
      if (!levels.may_step(p, other) || levels.at(p + other) != levels.at(on)) continue;
      const bool reached_at_even = other.x == 0 || other.y == 0 || levels.at(p) % 2 == 0;
      const auto far = [&](Cell q) {
        const Cell rest = task.goal - q;
        return rest.x * rest.x + rest.y * rest.y;
      };
      if (reached_at_even && far(p + other) < far(on)) return "another descent is nearer to the aim";
    }
  }
  if (!room.map.holds(task.goal)) return levels.is_rim(p) ? "" : "the way ends inside the window";
  return p == task.goal || (wavefront.outside() && levels.is_rim(p)) ? "" : "the way ends before the goal";
}

void run(Dice& dice, Wavefront& wavefront, Room& room, const Wavefront::Task& task) {
  wavefront.begin(room.map, task);
  const bool whole = dice.chance(0.5);
  while (!wavefront.run(room.map, whole ? INT32_MAX : 1 + dice.index(300))) {
  }
}

std::string judge_task(Dice& dice, Room& room) {
  const planning::GridShape& shape = room.map.shape();
  Wavefront::Task task;
  task.body = draw_cell(dice, shape);
  task.goal = draw_cell(dice, shape, dice.chance(0.5) ? 0 : 90);
  // In line with a rim of the window.
  if (dice.chance(0.2)) task.goal.y = dice.chance(0.5) ? 0 : shape.rows - dice.index(2);
  if (dice.chance(0.2)) task.goal.x = dice.chance(0.5) ? 0 : shape.columns() - dice.index(2);
  task.strict = dice.chance(0.5);
  if (dice.chance(0.2)) task.most = 1 + dice.index(60);
  if (dice.chance(0.1)) task.goal = task.body;
  const Levels levels(room, task);
  Wavefront wavefront;
  run(dice, wavefront, room, task);
  const int body = levels.at(task.body);
  if (room.map.holds(task.goal) && !wavefront.outside() && wavefront.levels() > task.most)
    return "more levels than allowed";
  if (body != kNever && body <= task.most) {
    if (!wavefront.reached() || wavefront.outside()) return "no way where there is one";
    if (wavefront.level() != body) return "another level of the body";
    const std::string wrong = judge_levels(room, levels, wavefront, task.most);
    return wrong.empty() ? judge_descent(room, levels, wavefront, task) : wrong;
  }
  if (task.most != INT32_MAX) {
    return room.map.holds(task.goal) && wavefront.reached() && !wavefront.outside()
               ? "a way longer than allowed"
               : "";
  }
  const bool from_goal = !room.map.holds(task.goal) || levels.has_way_out(task.goal);
  if (!from_goal || !levels.has_way_out(task.body)) return wavefront.reached() ? "a way through a wall" : "";
  if (!room.map.holds(task.goal)) return "";
  if (!wavefront.reached() || !wavefront.outside()) return "no way around outside";
  const int least = planning::cell_distance(task.body - task.goal);
  if (wavefront.level() < least) return "a way that is too short";
  return judge_descent(room, levels, wavefront, task);
}

}  // namespace

std::string judge_wavefront(Dice& dice) {
  Room room(draw_shape(dice), {}, {});
  room.scatter(dice, dice.uniform(0, 0.45), dice.chance(0.5) ? dice.uniform(0, 0.5) : 0);
  // A plan leaves nothing to the next one.
  std::string wrong = judge_task(dice, room);
  return wrong.empty() ? judge_task(dice, room) : wrong;
}

}  // namespace whisker::hunt
