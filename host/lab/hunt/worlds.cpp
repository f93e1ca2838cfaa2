#include "host/lab/hunt/worlds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "firmware/planning/goal_planner.hpp"
#include "host/harness/run/narrowest_gap.hpp"
#include "host/harness/scenario/bearing.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/scale.hpp"
#include "host/lab/campaign/random_robot.hpp"
#include "host/lab/hunt/geometry.hpp"
#include "host/lab/hunt/premise.hpp"

namespace whisker::hunt {
namespace {

using sim::Vec2;

constexpr double kPost_m = 0.001;
constexpr double kFarOff_m = 900;
constexpr int kTries = 20;

Vec2 turned(Vec2 v, sim::SinCos by) { return {v.x * by.cos - v.y * by.sin, v.x * by.sin + v.y * by.cos}; }

class Builder {
 public:
  Builder(Dice& dice, Scenario& scenario)
      : dice_(dice), s_(scenario), radius_(scenario.robot.body.radius.raw() * 1e-6) {
    keep_ = free_at_start_m(s_.robot);
    // Mostly the first movements have some room.
    if (!dice_.chance(0.3)) keep_ += dice_.log_uniform(1e-3, 0.5) * radius_;
  }

  void build(World world) {
    switch (world) {
      case World::scatter: return many(1, 14, [this] { anything(); });
      case World::posts: return many(2, 30, [this] { post(); });
      case World::needles: return many(1, 12, [this] { needle(); });
      case World::walls: return many(1, 12, [this] { wall(); });
      case World::rings: return many(1, 3, [this] { ring(); });
      case World::combs: return many(1, 3, [this] { comb(); });
      case World::corners: return many(1, 4, [this] { corner(); });
      case World::pocket: return pocket();
      case World::doors: return many(1, 5, [this] { door(); });
      case World::crowd: return crowd();
      case World::usual: return;
    }
  }

  void anything() {
    switch (dice_.index(6)) {
      case 0: return post();
      case 1: return disc(dice_.log_uniform(0.02, 6) * radius_);
      case 2: return needle();
      case 3: return corner();
      default: return wall();
    }
  }
  void post() { disc(dice_.chance(0.7) ? kPost_m : dice_.log_uniform(0.01, 0.3) * radius_); }

  void goal() {
    const double half_gap = narrowest_gap_m(s_.robot) / 2;
    const double least = planning::smallest_tolerance(s_.robot).raw() * 1e-6;
    s_.goal.tolerance_m = std::max(least, dice_.log_uniform(0.1, 2) * radius_);
    for (int i = 0; i < kTries; ++i) {
      s_.goal.at = dice_.around(s_.start.at, 2 * radius_, 26 * radius_);
      if (nearest(s_, s_.goal.at).distance_m > half_gap * 1.02) return;
    }
  }

 private:
  template <class Add>
  void many(int least, int most, const Add& add) {
    for (int i = least + dice_.index(most - least + 1); i > 0; --i) add();
    if (dice_.chance(0.25)) post();
    if (dice_.chance(0.1)) box(dice_.uniform(2, 12) * radius_);
  }

  /// Keeps what `add` adds to an empty world only if it leaves the start free.
  template <class Draw>
  void fit(const Draw& draw) {
    for (int i = 0; i < kTries; ++i) {
      Scenario trial;
      draw(trial);
      if (nearest(trial, s_.start.at).distance_m <= keep_) continue;
      s_.discs.insert(s_.discs.end(), trial.discs.begin(), trial.discs.end());
      s_.walls.insert(s_.walls.end(), trial.walls.begin(), trial.walls.end());
      s_.polygons.insert(s_.polygons.end(), trial.polygons.begin(), trial.polygons.end());
      return;
    }
  }

  Vec2 anywhere() { return dice_.around(s_.start.at, 1.02 * radius_, 9 * radius_); }
  /// In a third of the draws it nearly touches the ground that must be free.
  void disc(double size) {
    fit([&](Scenario& trial) {
      Vec2 at = anywhere();
      if (dice_.chance(0.3)) {
        at = s_.start.at + dice_.direction() * (keep_ + size + dice_.log_uniform(1e-6, 0.3) * radius_);
      }
      trial.discs.push_back({at, size});
    });
  }

  void wall() {
    fit([&](Scenario& trial) {
      const Vec2 from = anywhere();
      Vec2 way = dice_.direction() * (dice_.log_uniform(0.02, 15) * radius_);
      if (dice_.chance(0.3)) way = dice_.chance(0.5) ? Vec2{way.x, 0} : Vec2{0, way.y};
      if (way.x == 0 && way.y == 0) way.x = radius_;
      trial.walls.push_back({from, from + way});
    });
  }

  void needle() {
    fit([&](Scenario& trial) {
      const Vec2 tip = anywhere(), way = dice_.direction() * (dice_.log_uniform(0.1, 6) * radius_);
      const Vec2 other = turned(way, sim::sin_cos(dice_.log_uniform(0.005, 0.6)));
      trial.polygons.push_back({tip, tip + way, tip + other});
    });
  }

  void corner() {
    fit([&](Scenario& trial) {
      const Vec2 tip = anywhere();
      const sim::SinCos half = sim::sin_cos(dice_.log_uniform(0.02, 1.2));
      Vec2 back = s_.start.at - tip;
      if (dice_.chance(0.3)) back = dice_.direction() * radius_;
      back = back * dice_.log_uniform(0.3, 3);
      trial.walls.push_back({tip + turned(back, half), tip, tip + turned(back, {-half.sin, half.cos})});
    });
  }

  void ring() {
    fit([&](Scenario& trial) {
      const double size = dice_.log_uniform(1.1, 14) * radius_;
      const double door = dice_.chance(0.3) ? 0 : narrowest_gap_m(s_.robot) * dice_.uniform(0.99, 2) / size;
      if (door > 3) return;
      const Vec2 centre = s_.start.at + dice_.direction() * (dice_.uniform(0, 0.3) * radius_);
      const double first = dice_.uniform(0, 2 * sim::kPi), round = 2 * sim::kPi - door;
      const int edges = 3 + dice_.index(30);
      std::vector<Vec2> points;
      for (int i = 0; i <= edges; ++i) {
        const sim::SinCos turn = sim::sin_cos(first + round * i / edges);
        points.push_back(centre + Vec2{turn.cos, turn.sin} * size);
      }
      trial.walls.push_back(points);
    });
  }

  void comb() {
    fit([&](Scenario& trial) {
      const Vec2 along = dice_.direction(), side{-along.y, along.x};
      const Vec2 from = anywhere();
      const double space = dice_.chance(0.5) ? narrowest_gap_m(s_.robot) * dice_.uniform(0.98, 1.6)
                                             : dice_.log_uniform(0.05, 4) * radius_;
      const double tooth = dice_.log_uniform(0.2, 6) * radius_;
      const int teeth = 2 + dice_.index(8);
      if (dice_.chance(0.6)) trial.walls.push_back({from, from + along * (space * teeth)});
      for (int i = 0; i <= teeth; ++i) {
        trial.walls.push_back({from + along * (space * i), from + along * (space * i) + side * tooth});
      }
    });
  }

  void door() {
    fit([&](Scenario& trial) {
      const Vec2 along = dice_.direction(), side{-along.y, along.x};
      const double near = dice_.chance(0.5) ? dice_.uniform(0.99, 1.01) : dice_.uniform(1, 2.5);
      const double half = narrowest_gap_m(s_.robot) * near / 2;
      const Vec2 middle = s_.start.at + along * (dice_.log_uniform(1.1, 12) * radius_) +
                          side * (dice_.uniform(-5, 5) * radius_);
      const double far = dice_.log_uniform(2, 12) * radius_;
      trial.walls.push_back({middle + side * half, middle + side * (half + far)});
      trial.walls.push_back({middle - side * half, middle - side * (half + far)});
    });
  }

  void box(double half) {
    const Vec2 at = s_.start.at;
    const auto side = [&] { return half * dice_.uniform(0.5, 1); };
    Scenario trial;
    trial.bounds = Bounds{{at.x - side(), at.y - side()}, {at.x + half, at.y + side()}};
    if (nearest(trial, at).distance_m > keep_) s_.bounds = trial.bounds;
  }

  void pocket() {
    const auto side = [&] { return keep_ + dice_.log_uniform(1e-3, 3) * radius_; };
    const Vec2 at = s_.start.at;
    s_.bounds = Bounds{{at.x - side(), at.y - side()}, {at.x + side(), at.y + side()}};
    if (dice_.chance(0.3)) anything();
  }

  void crowd() {
    const int count = static_cast<int>(dice_.log_uniform(300, 10000));
    // One obstacle in 4 to 100 squares of the radius.
    const double half = std::sqrt(count * dice_.log_uniform(4, 100)) * radius_ / 2;
    const double size = std::max(kPost_m, dice_.log_uniform(0.003, 0.5) * radius_);
    for (int i = 0; i < count; ++i) {
      const Vec2 at = s_.start.at + Vec2{dice_.uniform(-half, half), dice_.uniform(-half, half)};
      if (length(at - s_.start.at) - size > keep_) s_.discs.push_back({at, size});
    }
  }

  Dice& dice_;
  Scenario& s_;
  double radius_;
  double keep_;
};

/// False if the start of the drawn world is not free.
bool take_usual(Dice& dice, Scenario& s) {
  constexpr worlds::Kind kKinds[] = {worlds::Kind::rooms, worlds::Kind::rooms,   worlds::Kind::discs,
                                     worlds::Kind::poles, worlds::Kind::u_trap,  worlds::Kind::spiral,
                                     worlds::Kind::maze,  worlds::Kind::enclosed};
  worlds::Options options;
  options.seed = dice.bits() >> 2;
  const worlds::Kind kind = kKinds[dice.index(8)];
  if (kind == worlds::Kind::discs && dice.chance(0.5)) options.discs = 50;
  Scenario made = worlds::generate(kind, options);
  worlds::scale_lengths(made, campaign::size_of(s.robot));
  if (nearest(made, made.start.at).distance_m <= free_at_start_m(s.robot)) return false;
  made.robot = s.robot;
  made.name = s.name;
  made.seed = s.seed;
  s = std::move(made);
  return true;
}

void turn_start(Dice& dice, Scenario& s) { s.start.heading = dice.uniform(0, 360) * kRadPerDeg; }

template <class Change>
void each_point(Scenario& s, const Change& change) {
  for (sim::Disc& disc : s.discs) change(disc.center);
  for (auto* shapes : {&s.walls, &s.polygons}) {
    for (auto& points : *shapes) {
      for (Vec2& p : points) change(p);
    }
  }
  if (s.bounds) {
    change(s.bounds->min);
    change(s.bounds->max);
  }
}

template <class Shape>
void drop_one(Dice& dice, std::vector<Shape>& shapes) {
  if (!shapes.empty()) shapes.erase(shapes.begin() + dice.index(static_cast<int>(shapes.size())));
}

}  // namespace

const char* name(World world) {
  constexpr const char* kNames[kWorlds] = {"scatter", "posts",  "needles", "walls", "rings", "combs",
                                           "corners", "pocket", "doors",   "crowd", "usual"};
  return kNames[static_cast<int>(world)];
}

World draw_world(Dice& dice, Scenario& s) {
  auto world = static_cast<World>(dice.index(kWorlds));
  if (loses_walls(s.robot.rangefinders) && dice.chance(0.5)) world = World::usual;
  // Many obstacles make slow trials.
  if (world == World::crowd && dice.chance(0.7)) world = World::scatter;
  if (world == World::usual && !take_usual(dice, s)) world = World::scatter;
  if (world != World::usual) {
    turn_start(dice, s);
    Builder builder(dice, s);
    builder.build(world);
    builder.goal();
  }
  if (dice.chance(0.05)) shift(s, {dice.uniform(-kFarOff_m, kFarOff_m), dice.uniform(-kFarOff_m, kFarOff_m)});
  return world;
}

void change_world(Dice& dice, Scenario& s) {
  const double radius = s.robot.body.radius.raw() * 1e-6;
  switch (dice.index(5)) {
    case 0: return turn_start(dice, s);
    case 1: return Builder(dice, s).anything();
    case 2: {
      drop_one(dice, s.discs);
      drop_one(dice, s.walls);
      return drop_one(dice, s.polygons);
    }
    case 3: {
      const double far = dice.log_uniform(1e-4, 0.3) * radius;
      return each_point(s, [&](Vec2& p) {
        if (dice.chance(0.3)) p = p + dice.direction() * far;
      });
    }
    default: s.start.at = dice.around(s.start.at, 1e-4 * radius, radius);
  }
}

void shift(Scenario& s, Vec2 by) {
  s.start.at = s.start.at + by;
  s.goal.at = s.goal.at + by;
  each_point(s, [by](Vec2& p) { p = p + by; });
  for (Event& e : s.events) {
    e.goal.at = e.goal.at + by;
    if (e.x_m) *e.x_m += by.x;
    if (e.y_m) *e.y_m += by.y;
  }
}

}  // namespace whisker::hunt
