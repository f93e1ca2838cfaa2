// Turns and drives of a body with lag and encoders, from the request to the place where it stands.
#include <algorithm>
#include <cmath>

#include "firmware/localization/odometry.hpp"
#include "firmware/math/wheel_kinematics.hpp"
#include "firmware/planning/motion_controller.hpp"
#include "firmware/planning/steering.hpp"
#include "host/harness/run/spec.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using planning::Manoeuvre;
using planning::ManoeuvreKind;
using planning::MotionController;

class Body {
 public:
  explicit Body(const Params& p) : p_(p) {
    odometry_.configure(p);
    controller_.configure(p);
    odometry_.place({});
    tick();
  }
  void begin(const Manoeuvre& m) { controller_.begin(m, odometry_.pose()); }
  void tick(Duration held_for = {}, bool blocked = false) {
    localization::CountStep step;
    const auto count = [&](double way) {
      const double counts = std::floor(way * p_.wheels.counts_per_metre);
      return static_cast<std::uint32_t>(static_cast<std::int64_t>(counts) & 0xFFFFFF);
    };
    odometry_.update({count(way_[0]), count(way_[1])}, p_.safety.period, step);
    const Duration period = p_.safety.period;
    request = controller_.request(odometry_.pose(), period, held_for, p_);
    const WheelPair want = inverse_kinematics(request.forward, request.turning, p_.wheels.max_speed);
    speeds = slew(speeds, want, p_.wheels.max_acceleration * period);
    controller_.settle(&step, speeds.left != Speed{} || speeds.right != Speed{}, period, p_);
    const double commanded[] = {speeds.left.raw() * 1e-6, speeds.right.raw() * 1e-6};
    const double lag_s = p_.wheels.motor_lag.raw() * 1e-3, step_s = period.raw() * 1e-4;
    for (int sub = 0; sub < 10; ++sub) {
      for (int w = 0; w < 2; ++w) {
        v_[w] += (commanded[w] - v_[w]) * (lag_s > 0 ? 1 - std::exp(-step_s / lag_s) : 1);
        if (!blocked) way_[w] += v_[w] * step_s;
      }
    }
  }
  /// The ticks until it stands.
  int run(int most) {
    int ticks = 0;
    while (ticks < most && !controller_.settled()) {
      tick();
      ++ticks;
    }
    return ticks;
  }
  Pose pose() const { return odometry_.pose(); }
  const MotionController& controller() const { return controller_; }
  MotionController& controller() { return controller_; }
  planning::VelocityRequest request;
  WheelPair speeds;

 private:
  const Params& p_;
  localization::Odometry odometry_;
  MotionController controller_;
  double way_[2] = {0, 0}, v_[2] = {0, 0};
};

/// Near the reference robot.
Params draw_body(Dice& dice) {
  while (true) {
    Params p;
    if (dice.chance(0.3)) return p;
    p.wheels.max_speed = Speed::from_raw(1000 * (100 + dice.index(300)));
    p.wheels.max_acceleration = Acceleration::from_raw(1000 * (500 + dice.index(2500)));
    // The time in which it settles leaves 30 ms: where it leaves a tick, a turn ends two degrees beside its
    // end.
    p.wheels.motor_lag = milliseconds(10 + dice.index(41));
    p.body.track = millimetres(90 + dice.index(80));
    if (check(p) == ParamFault::none) return p;
  }
}

double degrees(Angle a) { return radians(a) * 180 / sim::kPi; }
/// What the coarsest of tolerance and counts leaves.
double turn_slack(const Params& p) {
  return degrees(derived::turn_tolerance(p)) + degrees(planning::nearest_facing(Angle{}, p)) + 1.3;
}

std::string judge_turn(Dice& dice) {
  const Params p = draw_body(dice);
  Body body(p);
  const Angle to = Angle::turns(dice.index(3580) - 1790, 3600);
  body.begin({ManoeuvreKind::turn, to, {}, {}, {}});
  const double fastest =
      std::min(turn_rate(p).raw() * 1e-6, p.wheels.max_speed.raw() * 2e-6 / metres(p.body.track));
  const double needed_s = std::fabs(radians(to)) / fastest + 3;
  const double way = std::copysign(1, radians(to));
  const int most = static_cast<int>(needed_s / (p.safety.period.raw() * 1e-3));
  for (int tick = 0; tick < most && !body.controller().settled(); ++tick) {
    body.tick();
    const double turning = (body.speeds.right - body.speeds.left).raw() * way;
    if (tick < 10 && std::fabs(degrees(to)) > 5 && turning < 0) return "turns the longer way";
    if (body.request.moves && body.request.forward != Speed{}) return "a turn drives";
  }
  if (!body.controller().settled()) return "a turn does not end";
  if (std::fabs(degrees(body.pose().heading - to)) > turn_slack(p)) return "a turn ends elsewhere";
  if (body.controller().cut()) return "a turn is cut";
  return length_of(vec(body.pose().at)) < 0.003 ? "" : "a turn leaves its place";
}

std::string judge_drive(Dice& dice) {
  const Params p = draw_body(dice);
  Body body(p);
  const double way = 0.02 + dice.uniform(0, 1.2);
  const Angle heading = Angle::turns(dice.index(60) - 30, 3600);
  body.begin({ManoeuvreKind::drive, heading, micrometres(static_cast<std::int32_t>(way * 1e6)), {}, {}});
  const double needed_s = way / (p.wheels.max_speed.raw() * 1e-6) + 4;
  const int most = static_cast<int>(needed_s / (p.safety.period.raw() * 1e-3));
  for (int tick = 0; tick < most && !body.controller().settled(); ++tick) {
    if (dice.chance(0.01)) body.begin({});  // keep
    body.tick(dice.chance(0.1) ? milliseconds(dice.index(p.safety.period.raw() * 20)) : Duration{});
    if (body.request.moves && body.request.forward < Speed{}) return "a drive ahead drives back";
    if (abs(body.request.turning) > body.request.forward / 2 + Speed::from_raw(1))
      return "a drive turns a wheel back";
  }
  if (!body.controller().settled()) return "a drive does not end";
  if (body.controller().cut()) return "a free drive is cut";
  const double on = metres(along(body.pose().at, heading));
  if (std::fabs(on - way) > metres(derived::drive_tolerance(p)) + 0.004) return "a drive ends elsewhere";
  return std::fabs(metres(across(body.pose().at, heading))) < 0.01 + 0.05 * way ? ""
                                                                                : "a drive leaves its line";
}

/// The guard, a bump or an obstacle ends a drive; a turn goes on.
std::string judge_cut(Dice& dice) {
  const Params p = draw_body(dice);
  const int period = p.safety.period.raw();
  const int longest = std::max(period * 20, 1000 / p.rangefinders.rate_hz * 4);
  Body body(p);
  const bool turns = dice.chance(0.3), held = dice.chance(0.5);
  body.begin({turns ? ManoeuvreKind::turn : ManoeuvreKind::drive, turns ? 90_deg : 0_deg, 2_m, {}, {}});
  for (int i = 0; i < 10; ++i) body.tick(milliseconds(longest));
  if (body.controller().cut()) return "cut too soon";
  if (!held) {
    body.controller().interrupt();
    if (body.controller().cut() == turns) return "interrupted and not";
    if (turns)
      return body.run(1000) < 1000 && std::fabs(degrees(body.pose().heading) - 90) < turn_slack(p)
                 ? ""
                 : "a turn does not go on";
    return body.run(500) < 500 && metres(body.pose().at.x) < 1 ? "" : "an interrupted drive does not settle";
  }
  body.tick(milliseconds(longest + 1));
  if (body.controller().cut() == turns) return "held for too long and not cut";
  body.run(2000);
  if (!body.controller().settled()) return "a cut drive does not settle";
  body.begin({ManoeuvreKind::turn, 45_deg, {}, {}, {}});
  return body.controller().cut() || body.controller().settled() ? "cut from before" : "";
}

/// An obstacle that nobody sees: it waits as long as it may.
std::string judge_patience(Dice& dice) {
  const Params p = draw_body(dice);
  Body body(p);
  const bool turns = dice.chance(0.5);
  body.begin({turns ? ManoeuvreKind::turn : ManoeuvreKind::drive, turns ? 90_deg : 0_deg, 2_m, {}, {}});
  const int patience = derived::stalled_after(p).raw() / p.safety.period.raw();
  for (int i = 0; i < patience; ++i) body.tick({}, true);
  if (body.controller().cut()) return "no patience";
  const int waited = body.controller().waiting_for().raw();
  if (waited < (patience - 2) * p.safety.period.raw() || waited > patience * p.safety.period.raw())
    return "it waits for another time";
  for (int i = 0; i < 3; ++i) body.tick({}, true);
  return body.controller().cut() == turns ? "too much patience" : "";
}

std::string judge_cruise(Dice& dice) {
  const Params p = draw_body(dice);
  Body body(p);
  Manoeuvre m{ManoeuvreKind::cruise, {}, {}, {}, {}};
  const double track = metres(p.body.track);
  if (dice.chance(0.8)) m.forward = Speed::from_raw(dice.index(600000) - 300000);
  m.turning = Speed::from_raw(dice.chance(0.3) ? 0 : dice.index(2000000) - 1000000);
  body.begin(m);
  body.tick();
  const double fastest = (m.forward == Speed{} ? turn_rate(p) : p.wheels.max_turn_rate).raw() * track / 2;
  const double share =
      std::min(1.0, fastest / std::max(1.0, std::fabs(static_cast<double>(m.turning.raw()))));
  const auto off = [&](Speed is, Speed asked) { return std::fabs(is.raw() - asked.raw() * share); };
  if (!body.request.moves || off(body.request.turning, m.turning) > 20) return "a cruise turns otherwise";
  if (off(body.request.forward, m.forward) > 20) return "a cruise has another curvature";
  if (body.controller().settled() || body.controller().cut()) return "a cruise ends";
  if (dice.chance(0.5)) {
    for (int i = 0; i < 30; ++i) body.tick();
    const Vec from = body.pose().at;
    const Angle heading = body.pose().heading;
    if (abs(m.turning) > 5_mm_per_s || m.forward < Speed{}) return "";
    body.begin({ManoeuvreKind::drive, heading, 500_mm, {}, {}});
    if (body.run(2000) >= 2000) return "a drive after a cruise does not end";
    return std::fabs(metres(along(body.pose().at - from, heading)) - 0.5) < 0.01
               ? ""
               : "a drive after a cruise ends elsewhere";
  }
  body.begin(planning::stop());
  return body.run(600) < 600 && body.speeds.left == Speed{} ? "" : "a stop does not settle";
}

/// The speeds from which the body stops within a way, and their turns.
std::string judge_steering(Dice& dice) {
  const Params p = draw_body(dice);
  const double a = p.wheels.max_acceleration.raw() * 1e-6, track = metres(p.body.track);
  const Length rest = micrometres(dice.index(2000000) - 200000);
  const Duration delay = milliseconds(dice.index(300));
  const double v = planning::stopping_speed(rest, delay, p).raw() * 1e-6;
  const double stops = v * v / (2 * a) + v * delay.raw() * 1e-3;
  if (rest <= Length{} ? v != 0 : std::fabs(stops - metres(rest)) > 1e-5 + 1e-3 * metres(rest))
    return "it stops elsewhere";
  if (planning::approach_speed(rest, p) != planning::stopping_speed(rest, derived::settle_time(p), p))
    return "it approaches otherwise";
  const Angle error = Angle::turns(dice.index(3599) - 1799, 3600);
  const double e = radians(error), way = std::fabs(e) * track / 2;
  const auto turning = [&](const Manoeuvre& m) { return m.turning.raw() * 1e-6; };
  const auto stop_v = [&](double l) {
    const double t = derived::settle_time(p).raw() * 1e-3;
    return -a * t + std::sqrt(a * a * t * t + 2 * a * l);
  };
  const double rate = std::min(2.5, std::fabs(e) * 5) * track / 2;
  const Manoeuvre face = planning::face(error, p);
  if (face.kind != ManoeuvreKind::cruise || face.forward != Speed{}) return "facing drives";
  if (std::fabs(turning(face) - std::copysign(std::min(rate, stop_v(way)), e)) > 2e-4)
    return "it faces otherwise";
  const Speed top = p.wheels.max_speed;
  const Manoeuvre steer = planning::steer(error, top, p);
  const double part = std::max(0.0, 1 - 1.2 * std::fabs(e));
  if (std::fabs(steer.forward.raw() * 1e-6 - top.raw() * 1e-6 * part) > 1e-4)
    return "it steers at another speed";
  const double steers = std::min(std::min(2.5, std::fabs(e) * 6) * track / 2, stop_v(way) * 9 / 8);
  if (std::fabs(turning(steer) - std::copysign(steers, e)) > 3e-4) return "it steers otherwise";
  Manoeuvre m;
  const bool there = planning::turn_by(error, p, m);
  const double nearest = degrees(planning::nearest_facing(3_deg, p));
  const double count = 1 / (p.wheels.counts_per_metre * track) * 180 / sim::kPi * 9 / 8;
  if (std::fabs(nearest - std::max(3.0, count)) > 0.01) return "another nearest heading";
  return std::fabs(std::fabs(degrees(error)) - nearest) > 0.01 &&
                 there != (std::fabs(degrees(error)) < nearest)
             ? "it is there or not"
             : "";
}

}  // namespace

std::string judge_manoeuvres(Dice& dice) {
  for (int i = 0; i < 3; ++i) {
    for (const JudgePart judge : {judge_turn, judge_drive, judge_cut, judge_patience, judge_cruise}) {
      std::string wrong = judge(dice);
      if (!wrong.empty()) return wrong;
    }
  }
  for (int i = 0; i < 50; ++i) {
    std::string wrong = judge_steering(dice);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace whisker::hunt
