#include "host/lab/calibration/drive_procedure.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include <fmt/format.h>

#include "host/harness/sim/random.hpp"
#include "host/lab/calibration/hand_measured.hpp"

namespace whisker::calibration {
namespace {

constexpr std::uint32_t kHandStream = 0xCA13;
constexpr double kUnknownScale = 0.01;  // before the tape

Length metres(double m) { return Length::from_raw(static_cast<std::int32_t>(std::lround(m * 1e6))); }

/// The same true robot, seen from other parameters.
WheelErrors seen_from(const Params& now, const Params& believed, const WheelErrors& e) {
  const auto of = [&](Quantity q) { return true_value(believed, e, q) / value_in(now, q); };
  return {of(Quantity::gyro_scale), of(Quantity::wheel_ratio), of(Quantity::counts_per_metre),
          of(Quantity::track)};
}

SpinSeen seen(const planning::SpinPlanner& planner) {
  using planning::ProfileMatch;
  constexpr double kDegrees = 360.0 / planning::RangeProfile::kTurn;
  SpinSeen seen{planner.first(), planner.last(), {}, planner.match().offset() * kDegrees / 256};
  for (int i = 0; i < ProfileMatch::kCoarsePoints; ++i)
    seen.mismatch_mm.push_back(planner.match().mismatch(i));
  return seen;
}

class Player {
 public:
  Player(const Params& believed, const Sensor& sensor, const Noise& noise, const WheelErrors& errors,
         const ProcedurePlan& plan, std::uint64_t seed)
      : believed_(believed),
        sensor_(sensor),
        noise_(noise),
        errors_(errors),
        plan_(plan),
        seed_(seed),
        hand_(seed, kHandStream) {
    done_.calibrated = believed;
  }

  Procedure play() {
    if (believed_.gyro.fitted == Fitted::yes) {
      tape();
      spin();
      straight();
    } else {
      // Unequal wheels drive a curve along the tape: the squares come first.
      spin();
      squares();
      if (done_.steps.back().ended.good()) {
        tape();
      } else {
        end("tape", {"needs the squares first", 0}, "");
      }
    }
    return std::move(done_);
  }

 private:
  /// Each step has its own noise, whatever the steps before took.
  DriveRig rig() {
    const Params& now = done_.calibrated;
    return {now, sensor_, noise_, seen_from(now, believed_, errors_), seed_ * 64 + 8 * done_.steps.size()};
  }

  void end(const std::string& name, const Ended& ended, const std::string& found) {
    done_.steps.push_back({name, ended.good() ? found : "", ended});
    if (!ended.good()) return;
    Params params = believed_;
    const ParamFault fault = apply(done_.values, params);
    if (fault != ParamFault::none) done_.refused = fault;
    done_.calibrated = params;
  }

  void tape() {
    planning::StraightPlanner planner(done_.calibrated, metres(plan_.tape_m),
                                      planning::StraightPlanner::Way::there);
    DriveRig robot = rig();
    const Ended ended = robot.straight(planner);
    const Tape tape{planner.way(), metres(robot.distance_m() + plan_.tape_sigma_m * hand_.normal())};
    Ended read = ended;
    if (ended.good() && !take_tape(done_.values, done_.calibrated, tape, metres(plan_.tape_sigma_m))) {
      read.trouble = planning::name(planning::Trouble::wrong_tape);
    }
    if (read.good() && !ends_.empty()) fit_again(tape);
    end("tape", read,
        fmt::format("drove {:.3f} m by its wheels, {:.3f} m by the tape", tape.driven.raw() * 1e-6,
                    tape.measured.raw() * 1e-6));
  }

  /// The squares, now that their true size is known.
  void fit_again(const Tape& tape) {
    const double scale = 1.0 * tape.measured.raw() / tape.driven.raw();
    std::vector<SquareEnd> ends = ends_;
    for (SquareEnd& end : ends) end.believed_x_m *= scale, end.believed_y_m *= scale;
    Params params = driven_;
    params.body.track = metres(driven_.body.track.raw() * 1e-6 * scale);
    take_squares(ends, plan_.side_m * scale, plan_.tape_sigma_m / plan_.tape_m, params, done_.values);
  }

  void spin() {
    const Params params = done_.calibrated;
    const auto made = std::make_unique<planning::SpinPlanner>(params);
    planning::SpinPlanner& planner = *made;
    const Ended ended = rig().spin(scene(plan_.scene, believed_, seed_), planner);
    take(planner.values());
    done_.spin = seen(planner);
    end("spin", ended,
        fmt::format("{} turns; the readings of the first and the last one differ by {} mm, {} mm where they "
                    "do not match",
                    planning::SpinPlanner::kTurns, planner.match().least(), planner.match().mean()));
  }

  void straight() {
    planning::StraightPlanner planner(done_.calibrated, metres(plan_.straight_m),
                                      planning::StraightPlanner::Way::there_and_back);
    const Ended ended = rig().straight(planner);
    take(planner.values());
    end("straight", ended, fmt::format("{} m there and back", plan_.straight_m));
  }

  void squares() {
    DriveRig robot = rig();
    driven_ = done_.calibrated;
    std::vector<SquareEnd>& ends = ends_;
    Ended all;
    for (int i = 0; i < 2 * plan_.squares && all.good(); ++i) {
      SquareEnd end;
      end.left = i % 2 == 0;
      planning::SquarePlanner planner(metres(plan_.side_m), end.left ? planning::SquarePlanner::Side::left
                                                                     : planning::SquarePlanner::Side::right);
      const Ended one = robot.square(planner, end);
      all = {one.trouble, all.time_s + one.time_s};
      end.x_m += plan_.corner_sigma_m * hand_.normal();
      end.y_m += plan_.corner_sigma_m * hand_.normal();
      ends.push_back(end);
    }
    Umbmark found;
    try {
      if (all.good()) found = take_squares(ends, plan_.side_m, kUnknownScale, driven_, done_.values);
    } catch (const std::exception& e) {
      all.trouble = e.what();
    }
    if (!all.good()) ends.clear();
    end("squares", all,
        fmt::format("{} of {} m to each side; ratio and track leave {:.1f} mm of a coordinate", plan_.squares,
                    plan_.side_m, found.residual_m * 1e3));
  }

  void take(const Values& found) {
    for (int i = 0; i < kQuantities; ++i) {
      if (found.of[i].known()) done_.values.of[i] = found.of[i];
    }
  }

  const Params& believed_;
  const Sensor& sensor_;
  const Noise& noise_;
  const WheelErrors& errors_;
  const ProcedurePlan& plan_;
  std::uint64_t seed_;
  sim::Random hand_;
  Params driven_;  // by the squares
  std::vector<SquareEnd> ends_;
  Procedure done_;
};

}  // namespace

bool Procedure::complete() const {
  return refused == ParamFault::none &&
         std::all_of(steps.begin(), steps.end(), [](const ProcedureStep& s) { return s.ended.good(); });
}

Procedure play(const Params& believed, const Sensor& sensor, const Noise& noise, const WheelErrors& errors,
               const ProcedurePlan& plan, std::uint64_t seed) {
  return Player(believed, sensor, noise, errors, plan, seed).play();
}

double best_value(const Params& believed, const WheelErrors& errors, const Values& found, Quantity quantity) {
  const double value = true_value(believed, errors, quantity);
  const Measured counts = found[Quantity::counts_per_metre];
  if (quantity != Quantity::track || !counts.known()) return value;
  return value * true_value(believed, errors, Quantity::counts_per_metre) / counts.value;
}

}  // namespace whisker::calibration
