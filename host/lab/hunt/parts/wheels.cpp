// Where the wheels take the body, and whether they follow, against wheels in double.
#include <algorithm>
#include <cmath>

#include "firmware/safety/coasting.hpp"
#include "firmware/safety/stall_watch.hpp"
#include "firmware/safety/warning.hpp"
#include "firmware/safety/wheel_watch.hpp"
#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using safety::WheelWatch;

double si(Speed v) { return v.raw() * 1e-6; }
Speed speed(double v) { return Speed::from_raw(static_cast<std::int32_t>(std::lround(v * 1e6))); }

struct Place {
  sim::Vec2 at;
  double heading;
};

Place moved(const Place& from, double left, double right, double track) {
  const double turn = (right - left) / track, half = turn / 2;
  const double chord = (left + right) / 2 * (std::fabs(half) < 1e-9 ? 1 : std::sin(half) / half);
  return {from.at + sim::Vec2{std::cos(from.heading + half), std::sin(from.heading + half)} * chord,
          from.heading + turn};
}

struct Wheels {
  Params p;
  WheelPair command, rolling;
  explicit Wheels(Dice& dice) {
    p.body.track = micrometres(static_cast<std::int32_t>(dice.log_uniform(0.03, 0.5) * 1e6));
    p.wheels.max_acceleration =
        Acceleration::from_raw(static_cast<std::int32_t>(dice.log_uniform(0.3, 20) * 1e6));
    p.wheels.motor_lag = milliseconds(static_cast<std::int32_t>(dice.log_uniform(1, 500)));
    p.safety.max_gap = milliseconds(20 + dice.index(230));
    const double turning = dice.uniform(-1, 1) * std::min(10 * metres(p.body.track), 1.0);
    const double forward = dice.chance(0.2) ? 0 : dice.uniform(-0.5, 1);
    rolling = {speed(forward - turning), speed(forward + turning)};
    // The command follows from what rolls within the lag.
    const double most = std::min(1.0, p.wheels.max_acceleration.raw() * 1e-9 * p.wheels.motor_lag.raw());
    command = {rolling.left + speed(dice.uniform(-most, most)),
               rolling.right + speed(dice.uniform(-most, most))};
  }
  WheelState state() const { return {command, command, rolling}; }
  double hold_s() const { return longest_gap(p).raw() * 1e-3; }
  double braking_s() const {
    return std::max(std::fabs(si(command.left)), std::fabs(si(command.right))) /
           (p.wheels.max_acceleration.raw() * 1e-6);
  }
  double lag_s() const { return p.wheels.motor_lag.raw() * 1e-3; }
};

std::vector<Place> simulated(const Wheels& w) {
  constexpr double kStep = 2e-4;
  double left = si(w.rolling.left), right = si(w.rolling.right);
  const double follows = 1 - std::exp(-kStep / w.lag_s());
  std::vector<Place> places{{{}, 0}};
  for (double t = kStep / 2; t < w.hold_s() + w.braking_s() + 10 * w.lag_s(); t += kStep) {
    const double braked = (t - w.hold_s()) / w.braking_s();
    const double share = braked < 0 ? 1 : std::max(0.0, 1 - braked);
    left += (share * si(w.command.left) - left) * follows;
    right += (share * si(w.command.right) - right) * follows;
    places.push_back(moved(places.back(), left * kStep, right * kStep, metres(w.p.body.track)));
  }
  return places;
}

double from_line(sim::Vec2 p, sim::Vec2 a, sim::Vec2 b) {
  const sim::Vec2 way = b - a;
  const double squared = sim::dot(way, way);
  const double on = squared > 0 ? std::clamp(sim::dot(p - a, way) / squared, 0.0, 1.0) : 0;
  return length_of(p - a - way * on);
}

std::string judge_shape(Dice& dice) {
  const Wheels w(dice);
  const Length allowed = micrometres(static_cast<std::int32_t>(dice.log_uniform(300, 5000)));
  const double track = metres(w.p.body.track);
  std::vector<Place> pieces{{{}, 0}};
  safety::Coasting coasting(w.command, w.state(), w.p, allowed);
  for (safety::Arc arc; coasting.next(arc);) {
    const double turn = std::fabs(metres(arc.right) - metres(arc.left)) / track;
    const int steps = 10 + static_cast<int>(turn * 20);
    for (int i = 0; i < steps; ++i) {
      pieces.push_back(moved(pieces.back(), metres(arc.left) / steps, metres(arc.right) / steps, track));
    }
  }
  const std::vector<Place> truth = simulated(w);
  for (std::size_t i = 0; i < truth.size(); i += 60) {
    double nearest = 1e9;
    for (std::size_t k = 0; k + 1 < pieces.size(); ++k) {
      nearest = std::min(nearest, from_line(truth[i].at, pieces[k].at, pieces[k + 1].at));
    }
    if (nearest > metres(allowed) * 1.05 + 0.0015) return "the body leaves the way on which it coasts";
  }
  // Not longer than it is, either.
  return length_of(pieces.back().at - truth.back().at) < metres(allowed) + 0.003 ? ""
                                                                                 : "it coasts to another end";
}

std::string judge_lengths(Dice& dice) {
  const Wheels w(dice);
  const Length allowed = dice.chance(0.5) ? 100_m : Length::from_raw(1 + dice.index(3000));
  safety::Coasting coasting(w.command, w.state(), w.p, allowed);
  double left = 0, right = 0;
  int count = 0;
  for (safety::Arc arc; coasting.next(arc); ++count) {
    left += metres(arc.left);
    right += metres(arc.right);
    const double turn = (metres(arc.right) - metres(arc.left)) / metres(w.p.body.track);
    if (std::fabs(static_cast<double>(arc.turn(w.p.body.track)) / 4294967296.0 * 2 * sim::kPi - turn) >
        1e-4 + 1e-3 * std::fabs(turn))
      return "an arc turns otherwise";
    if (std::fabs(metres(arc.length()) - (metres(arc.left) + metres(arc.right)) / 2) > 2e-6)
      return "an arc has another length";
    if (count > 1000) return "coasts for ever";
  }
  const auto due = [&](Speed rolls, Speed commanded) {
    return si(rolls) * w.lag_s() + si(commanded) * (w.hold_s() + w.braking_s() / 2);
  };
  const double slack = 5e-5 + 1e-3 * std::max(std::fabs(left), std::fabs(right));
  const bool off = std::fabs(left - due(w.rolling.left, w.command.left)) > slack + 0.02 * w.lag_s() ||
                   std::fabs(right - due(w.rolling.right, w.command.right)) > slack + 0.02 * w.lag_s();
  return off ? "coasts another way" : "";
}

}  // namespace

std::string judge_coasting(Dice& dice) {
  for (int i = 0; i < 60; ++i) {
    std::string wrong = judge_lengths(dice);
    if (wrong.empty() && i % 10 == 0) wrong = judge_shape(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

namespace {

/// One wheel of two does something else than it is commanded.
struct Rolling {
  Params p;
  WheelWatch watch;
  double way[2] = {0.4, 0.7};  // counts
  std::int64_t shown[2] = {0, 0};
  explicit Rolling(Dice& dice) {
    p.wheels.counts_per_metre = static_cast<std::int32_t>(dice.log_uniform(800, 20000));
    p.body.radius = millimetres(30 + dice.index(200));
    p.wheels.max_speed = Speed::from_raw(1000 * (50 + dice.index(450)));
    p.wheels.motor_lag = milliseconds(dice.chance(0.5) ? dice.index(500) : 50);
    watch.configure(p);
  }
  double at_full_speed(Duration time) const { return si(p.wheels.max_speed) * time.raw() * 1e-3; }
  double stretch() const {
    const double scaled = 0.04 * metres(p.body.radius) / metres(Params{}.body.radius);
    return std::max({scaled, 10.0 / p.wheels.counts_per_metre, 2 * at_full_speed(longest_gap(p)),
                     2 * at_full_speed(p.wheels.motor_lag)});
  }
  double of_a_runaway() const {
    return std::max(stretch(), 2 * at_full_speed(longest_gap(p) + p.wheels.motor_lag));
  }
  WheelWatch::Finding tick(Speed left, Speed right, double share_left, double share_right,
                           Duration elapsed = 10_ms) {
    return roll({left, right}, si(left) * share_left, si(right) * share_right, elapsed);
  }
  /// What is expected, and the true speeds in m/s.
  WheelWatch::Finding roll(WheelPair expected, double left, double right, Duration elapsed = 10_ms) {
    watch.expect(expected, elapsed);
    const double s = elapsed.raw() * 1e-3 * p.wheels.counts_per_metre;
    way[0] += left * s;
    way[1] += right * s;
    std::int32_t step[2];
    for (int i = 0; i < 2; ++i) {
      const auto now = static_cast<std::int64_t>(std::floor(way[i]));
      step[i] = static_cast<std::int32_t>(now - shown[i]);
      shown[i] = now;
    }
    return watch.judge({step[0], step[1]});
  }
};

std::string judge_follow(Dice& dice) {
  Rolling r(dice);
  const double share = dice.log_uniform(0.45, 2.4);
  Speed left{}, right{};
  for (int tick = 0; tick < 1500; ++tick) {
    if (tick % 200 == 0) {
      left = speed(dice.uniform(0.2, 1) * si(r.p.wheels.max_speed));
      right = speed(dice.uniform(0.2, 1) * si(r.p.wheels.max_speed));
      if (dice.chance(0.3)) left = -left;
    }
    if (r.tick(left, right, share, 1) != WheelWatch::Finding::none) return "a wheel that follows is no fault";
  }
  return "";
}

/// Wheels that have only a share of the stated lag, driven to and fro.
std::string judge_sooner(Dice& dice) {
  Rolling r(dice);
  const double full = si(r.p.wheels.max_speed), tick_s = 0.01;
  const double step = dice.log_uniform(0.1, 10) * tick_s, share = dice.uniform(0, 1);
  const double lag_s = r.p.wheels.motor_lag.raw() * 1e-3;
  const int half = 5 + dice.index(200);
  const auto follow = [&](double& at, double lag, double command) {
    at = lag > 0 ? command + (at - command) * std::exp(-tick_s / lag) : command;
  };
  double command = 0, stated = 0, real = 0;
  for (int tick = 0; tick < 1500; ++tick) {
    const double wanted = tick / half % 2 == 0 ? full : -full;
    command += std::clamp(wanted - command, -step, step);
    follow(stated, lag_s, command);
    follow(real, lag_s * share, command);
    if (r.roll({speed(stated), speed(stated)}, real, real) != WheelWatch::Finding::none)
      return "a wheel that follows sooner is no fault";
  }
  return "";
}

std::string judge_disobey(Dice& dice) {
  Rolling r(dice);
  const bool second = dice.chance(0.5);
  const int how = dice.index(4);  // stands, creeps, runs back, runs away
  const double share[] = {0, 0.1, -1, 4.5};
  const WheelWatch::Finding due = how < 2 ? WheelWatch::Finding::stalled : WheelWatch::Finding::runaway;
  const Speed v = r.p.wheels.max_speed * (1 + dice.index(4)) / 4;
  const Speed signed_v = dice.chance(0.5) ? v : -v;
  const double stretch = how < 2 ? r.stretch() : r.of_a_runaway();
  const double count = 1.0 / r.p.wheels.counts_per_metre;
  double commanded = 0;
  WheelWatch::Finding found = WheelWatch::Finding::none;
  while (commanded < 3 * stretch && found == WheelWatch::Finding::none) {
    commanded += si(v) * 0.01;
    found = r.tick(signed_v, signed_v, second ? 1 : share[how], second ? share[how] : 1);
    const double counted = commanded * std::fabs(share[how]);
    const bool early = std::max(commanded, counted) * 1.03 + 5 * count < stretch;
    if (found != WheelWatch::Finding::none && early) return "a wheel is judged too soon";
  }
  if (found == WheelWatch::Finding::none) return "a wheel that does not follow is not noticed";
  if (found != due && how != 1) return "a wheel has another fault";
  const double most = std::max(1.0, 1 / std::max(1.0, std::fabs(share[how]))) * stretch;
  return commanded <= 1.03 * most + 2 * si(v) * 0.01 + 25 * count ? "" : "a wheel is judged too late";
}

/// Both wheels are held for a while, or one that hardly turns holds the heading.
std::string judge_held(Dice& dice) {
  Rolling r(dice);
  const Speed v = r.p.wheels.max_speed / 2;
  const int ticks = 50 + dice.index(500);
  for (int tick = 0; tick < ticks; ++tick) {
    if (r.tick(v, v, 0, 0) != WheelWatch::Finding::none) return "two held wheels are one";
  }
  for (int tick = 0; tick < 300; ++tick) {
    if (r.tick(v, v, 1, 1) != WheelWatch::Finding::none) return "released wheels are a fault";
  }
  if (si(r.p.wheels.max_speed) * 20 < 20 * r.stretch()) return "";
  Rolling s(dice);
  // So much that each swing counts, however little.
  double commanded = 0;
  const int rare = 10 + static_cast<int>(60.0 / s.p.wheels.counts_per_metre / (si(v) * 0.01));
  for (int tick = 0; commanded < 40 * s.stretch(); ++tick) {
    commanded += si(v) * 0.01;
    s.watch.expect({v, v}, 10_ms);
    const std::int32_t swing = tick % rare != 0 ? 0 : tick % (2 * rare) == 0 ? 3 : -3;
    if (s.watch.judge({0, swing}) != WheelWatch::Finding::none)
      return commanded > 3 * s.stretch() ? "" : "held too soon";
  }
  return "a wheel that stands beside one that swings is not noticed";
}

std::string judge_stall(Dice& dice) {
  Params p;
  p.wheels.motor_lag = milliseconds(dice.index(450));
  p.wheels.counts_per_metre = static_cast<std::int32_t>(dice.log_uniform(500, 20000));
  const Duration step = milliseconds(5 + dice.index(20));
  const Speed v = Speed::from_raw(3000 + dice.index(300000));
  const int kind = dice.index(4);
  const WheelPair speeds = kind == 0   ? WheelPair{v, v}
                           : kind == 1 ? WheelPair{-v, v}
                           : kind == 2 ? WheelPair{{}, v}
                                       : WheelPair{-v, {}};
  const double per_tick = si(v) * step.raw() * 1e-3, ten_counts = 10.0 / p.wheels.counts_per_metre;
  safety::StallWatch watch;
  // A count or a pause begins anew.
  for (int i = 0; i < 3; ++i) {
    const int before = dice.index(derived::stalled_after(p).raw() / step.raw());
    for (int tick = 0; tick < before; ++tick) {
      if (watch.stalled({}, true, speeds, step, p)) return "stalled too soon";
    }
    const bool pause = i == 0;
    if (watch.stalled(pause    ? localization::CountStep{}
                      : i == 1 ? localization::CountStep{1, 0}
                               : localization::CountStep{0, -1},
                      !pause, speeds, step, p))
      return "a count is a stall";
  }
  for (int tick = 1; tick < 4000; ++tick) {
    const bool found = watch.stalled({}, true, speeds, step, p);
    const double ms = static_cast<double>(tick) * step.raw(), missing = per_tick * tick;
    if (found && (ms <= derived::stalled_after(p).raw() || missing < ten_counts * 0.95))
      return "stalled too soon";
    if (found) return "";
    if (ms > derived::stalled_after(p).raw() && missing > ten_counts * 1.02 + 4e-6 * tick)
      return "a stall is not noticed";
  }
  return "";
}

/// The speed from which the body stops before what its sensors may see late.
std::string judge_warning(Dice& dice) {
  Params p;
  p.rangefinders.side_angle = Angle::turns(10 + dice.index(70), 360);
  p.rangefinders.incidence = Angle::turns(20 + dice.index(69), 360);
  p.wheels.max_acceleration = Acceleration::from_raw(50000 + dice.index(5000000));
  p.rangefinders.latency = milliseconds(dice.index(200));
  p.rangefinders.rate_hz = 5 + dice.index(95);
  const bool err = dice.chance(0.5);
  const double radius = metres(p.body.radius);
  const double edge =
      std::min(sim::kPi / 2, radians(p.rangefinders.side_angle) + radians(p.rangefinders.cone) / 2);
  const double shortest = radius * std::sin(radians(p.rangefinders.incidence)) / std::sin(edge) * 2 / 3;
  if (std::fabs(metres(shortest_warning(p)) - shortest) > 1e-4) return "another shortest warning";
  const double v = si(safety::warned_speed(p, err)), a = p.wheels.max_acceleration.raw() * 1e-6;
  const double delay = p.rangefinders.latency.raw() * 1e-3 + (err ? 3.0 : 1.0) / p.rangefinders.rate_hz;
  if (v * delay + v * v / 2 / a > shortest * 1.001) return "a warning comes too late";
  const double settle = derived::settle_time(p).raw() * 1e-3 + 0.002;
  return v * (delay + settle) + v * v / 2 / a < shortest * 0.98 ? "slower than the warning asks for" : "";
}

}  // namespace

std::string judge_wheels(Dice& dice) {
  for (int i = 0; i < 15; ++i) {
    for (const JudgePart judge :
         {judge_follow, judge_sooner, judge_disobey, judge_held, judge_stall, judge_warning}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  return "";
}

}  // namespace whisker::hunt
