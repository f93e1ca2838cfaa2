// The pieces of the way against a fine simulation of two wheels with lag.
#include "firmware/safety/coasting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/effort.hpp"

namespace whisker::safety {
namespace {

struct Place {
  double x = 0, y = 0, heading = 0;
};
using Places = std::vector<Place>;

double metres(Length l) { return l.raw() * 1e-6; }
double si(Speed v) { return v.raw() * 1e-6; }
Speed speed(double v) { return Speed::from_raw(static_cast<std::int32_t>(std::lround(v * 1e6))); }

Place moved(const Place& from, double left, double right, double track) {
  const double turn = (right - left) / track, half = turn / 2;
  const double chord = (left + right) / 2 * (std::fabs(half) < 1e-9 ? 1 : std::sin(half) / half);
  return {from.x + chord * std::cos(from.heading + half), from.y + chord * std::sin(from.heading + half),
          from.heading + turn};
}

Places simulated(WheelPair command, const WheelState& wheels, const Params& p) {
  constexpr double kStep = 1e-4;
  const double lag = p.wheels.motor_lag.raw() * 1e-3, hold = longest_gap(p).raw() * 1e-3;
  const double acceleration = p.wheels.max_acceleration.raw() * 1e-6, track = metres(p.body.track);
  const double braking = std::fmax(std::fabs(si(command.left)), std::fabs(si(command.right))) / acceleration;
  double left = si(wheels.rolling.left), right = si(wheels.rolling.right);
  Places places{{}};
  for (double t = kStep / 2; t < hold + braking + 12 * lag; t += kStep) {
    const double share = t < hold ? 1 : t < hold + braking ? 1 - (t - hold) / braking : 0;
    const double follows = lag > 0 ? 1 - std::exp(-kStep / lag) : 1;
    left += (share * si(command.left) - left) * follows;
    right += (share * si(command.right) - right) * follows;
    places.push_back(moved(places.back(), left * kStep, right * kStep, track));
  }
  return places;
}

struct Pieces {
  int count = 0;
  Places places{{}};
};

Pieces pieces(WheelPair command, const WheelState& wheels, const Params& p, Length allowed) {
  Pieces way;
  Coasting coasting(command, wheels, p, allowed);
  for (Arc arc; coasting.next(arc); ++way.count) {
    const double turn = std::fabs(metres(arc.right) - metres(arc.left)) / metres(p.body.track);
    const int steps = 10 + static_cast<int>(turn * 20);
    for (int i = 0; i < steps; ++i) {
      way.places.push_back(moved(way.places.back(), metres(arc.left) / steps, metres(arc.right) / steps,
                                 metres(p.body.track)));
    }
  }
  return way;
}

double distance(const Place& p, const Place& a, const Place& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double on = length2 > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2 : 0;
  const double t = std::fmax(0, std::fmin(1, on));
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// How far a place of `from` may lie from all of `to`.
double farthest(const Places& from, const Places& to, std::size_t every) {
  double most = 0;
  for (std::size_t i = 0; i < from.size(); i += every) {
    double nearest = 1e9;
    for (std::size_t k = 0; k + 1 < to.size(); ++k)
      nearest = std::min(nearest, distance(from[i], to[k], to[k + 1]));
    most = std::max(most, nearest);
  }
  return most;
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  double spread(double low, double high) { return low * std::exp(uniform(0, std::log(high / low))); }
  bool chance(double p) { return uniform(0, 1) < p; }

 private:
  std::mt19937_64 random_;
};

Params robot(Draw& draw) {
  Params p;
  p.body.track = Length::from_raw(static_cast<std::int32_t>(draw.spread(0.03, 0.5) * 1e6));
  p.wheels.max_acceleration = Acceleration::from_raw(static_cast<std::int32_t>(draw.spread(0.3, 20) * 1e6));
  p.wheels.motor_lag = milliseconds(static_cast<std::int32_t>(draw.spread(1, 500)));
  p.safety.max_gap = milliseconds(static_cast<std::int32_t>(draw.uniform(20, 250)));
  return p;
}

/// The command follows from what rolls within the lag, and no body turns faster than 20 rad/s.
WheelPair near(Draw& draw, WheelPair rolling, const Params& p) {
  const double most = std::fmin(1, p.wheels.max_acceleration.raw() * 1e-9 * p.wheels.motor_lag.raw());
  return {rolling.left + speed(draw.uniform(-most, most)), rolling.right + speed(draw.uniform(-most, most))};
}

WheelPair draw_speeds(Draw& draw, const Params& p) {
  const double turning = draw.uniform(-1, 1) * std::fmin(10 * metres(p.body.track), 1);
  const double forward = draw.chance(0.2) ? 0 : draw.uniform(-0.5, 1);
  return {speed(forward - turning), speed(forward + turning)};
}

// WHISKER_LONG=1: 5,000.
TEST(Coasting, StaysNearTheTrueWay) {
  const auto count = test::effort(60, 5000);
  int divided = 0, most_pieces = 0;
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    Draw draw(seed);
    const Params p = robot(draw);
    const WheelPair rolling = draw_speeds(draw, p);
    const WheelPair command = near(draw, rolling, p);
    const Length allowed = micrometres(static_cast<std::int32_t>(draw.spread(300, 5000)));
    const WheelState wheels{command, command, rolling};
    const Pieces way = pieces(command, wheels, p, allowed);
    const double off = farthest(simulated(command, wheels, p), way.places, 40);
    EXPECT_LE(off, metres(allowed) + 0.0006) << "seed " << seed << ", " << way.count << " pieces";
    divided += way.count > 1 ? 1 : 0;
    most_pieces = std::max(most_pieces, way.count);
    worst = std::max(worst, off / metres(allowed));
  }
  std::printf("%d of %d divided, into %d pieces at most; at worst %.2f of what is allowed\n", divided,
              static_cast<int>(count), most_pieces, worst);
  EXPECT_GT(divided, 0);
  EXPECT_LT(divided, static_cast<int>(count));
}

// The length is the same however the way is divided.
TEST(Coasting, PiecesAddUp) {
  for (std::uint64_t seed = 1; seed <= test::effort(2000); ++seed) {
    Draw draw(seed);
    const Params p = robot(draw);
    const WheelPair rolling = draw_speeds(draw, p);
    const WheelPair command = near(draw, rolling, p);
    const WheelState wheels{command, command, rolling};
    const auto total = [&](Length allowed) {
      Coasting coasting(wheels.commanded, wheels, p, allowed);
      Arc sum{};
      for (Arc arc; coasting.next(arc);) sum = {sum.left + arc.left, sum.right + arc.right};
      return sum;
    };
    const Arc one = total(100_m), many = total(Length::from_raw(1));
    EXPECT_NEAR(one.left.raw(), many.left.raw(), 100) << "seed " << seed;
    EXPECT_NEAR(one.right.raw(), many.right.raw(), 100) << "seed " << seed;
  }
}

}  // namespace
}  // namespace whisker::safety
