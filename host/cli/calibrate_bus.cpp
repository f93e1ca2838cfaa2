#include "host/cli/calibrate_bus.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "firmware/can/controller_node.hpp"
#include "firmware/localization/odometry.hpp"
#include "firmware/planning/calibration/spin_planner.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/bus/fault_port.hpp"
#include "host/harness/hil/candump.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/hil/precedence.hpp"
#include "host/harness/hil/tap.hpp"
#include "host/harness/hil/wall_clock.hpp"
#include "host/lab/calibration/sample.hpp"
#include "host/lab/calibration/spin.hpp"

namespace whisker::cli {
namespace {

constexpr std::uint32_t kFarewell_ms = 500;  // the base hears that the mission is over, and cancels

/// The controller of a spin.
class Spinner {
 public:
  Spinner(hal::CanPort& port, const can::Identity& identity, const Params& params, double along_m)
      : node_(port, identity), params_(params), collector_(params), spin_(params, along_m) {
    odometry_.configure(params);
  }

  /// Every millisecond. False: the spin is over.
  bool poll(std::uint32_t now_ms) {
    node_.poll(now_ms);
    can::Order order = can::Order::cancel;
    can::Mission mission;
    if (node_.take_order(order, mission)) {
      if (order == can::Order::cancel && over()) return false;
      if (ordered_)
        throw SpinError(order == can::Order::cancel ? "the base cancelled" : "the base began anew");
      ordered_ = order == can::Order::start;
    }
    stopped();
    can::InputSet set;
    if (ordered_ && node_.take_set(set)) step(set);
    if (!over()) over_at_ms_ = now_ms;
    return now_ms - over_at_ms_ < kFarewell_ms;
  }

  std::string words() const {
    switch (node_.state()) {
      case can::NodeState::off_bus: return "waits for the bus";
      case can::NodeState::waiting:
        return (node_.errors() & can::Error::wrong_version) != 0 ? "the base speaks another protocol"
                                                                 : "waits for the base";
      case can::NodeState::ready: return over() ? "done" : "waits for the base's order to start";
      case can::NodeState::running:
        return fmt::format("turns on the spot, {:.0f} s in all", spin_.duration_s());
      case can::NodeState::safe_stop: return "safe stop: " + hil::error_names(node_.errors());
      case can::NodeState::e_stopped: return "E-stop";
    }
    return "";
  }

  bool lockstep() const { return node_.lockstep(); }
  bool other_params() const { return ordered_ && robot_digest(node_.params()) != robot_digest(params_); }
  const calibration::Sweep& sweep() const { return collector_.sweep(); }

 private:
  bool over() const { return spin_.done(); }

  void stopped() const {
    if (!ordered_ || over()) return;
    const can::NodeState state = node_.state();
    if (state == can::NodeState::e_stopped) throw SpinError("E-stop");
    if (state == can::NodeState::safe_stop) throw SpinError("safe stop: " + hil::error_names(node_.errors()));
    if (state != can::NodeState::running) throw SpinError("the base was lost");
  }

  void step(const can::InputSet& set) {
    if (!placed_) odometry_.place({});
    if (!placed_) first_ = last_ = set.tick;
    placed_ = true;
    const bool pressed = std::any_of(std::begin(set.bumps), std::end(set.bumps),
                                     [](can::BumpState b) { return b == can::BumpState::pressed; });
    if (pressed) throw SpinError("a bump switch is pressed");
    const double t_s = (set.tick - first_) * (set.period_ms * 1e-3);
    if (set.counts_valid) {
      const auto ms = static_cast<std::int32_t>(std::max<std::uint32_t>(set.tick - last_, 1) * set.period_ms);
      localization::CountStep counts;
      odometry_.update(set.counts, Duration::from_raw(ms), counts);
      last_ = set.tick;
      collector_.add(t_s, odometry_.pose(), set.ranges);
    }
    const hal::WheelSpeeds speeds = spin_.step(collector_.turned_rad(), collector_.from_start_m(), t_s);
    if (spin_.failed()) throw SpinError("the wheels do not turn as commanded");
    can::NavStatus status;
    status.outcome = spin_.done() ? planning::Outcome::reached : planning::Outcome::running;
    node_.answer(speeds, status);
  }

  can::ControllerNode node_;
  const Params& params_;
  localization::Odometry odometry_;
  calibration::Collector collector_;
  calibration::Spin spin_;
  bool ordered_ = false;
  bool placed_ = false;
  std::uint32_t first_ = 0, last_ = 0;
  std::uint32_t over_at_ms_ = 0;
};

}  // namespace

calibration::Sweep spin_on_bus(const BusChoice& bus, const Params& params, double along_m, hil::Line& line) {
  const Interrupt interrupt;
  hil::Recorder recorder(bus.record, bus.name);
  hil::Tap tap(line.port(), [&recorder](const hal::CanFrame& frame) { recorder.write(frame); });
  bus::Schedule faults;
  if (bus.drop_percent > 0) {
    bus::Fault loss{bus::FaultKind::loss};
    loss.chance = bus.drop_percent / 100;
    faults.push_back(loss);
  }
  bus::FaultPort port(tap, std::move(faults), static_cast<std::uint64_t>(bus.robot));
  hil::WallClock clock([&line] { return line.descriptor(); });
  Spinner spinner(port, bus.identity(), params, along_m);
  std::string said;
  const auto say = [&](const std::string& words) {
    if (words != said) fmt::print(stderr, "controller {} on {}: {}\n", bus.robot, bus.name, words);
    said = words;
  };
  const std::string forbidden = bus.real_time ? hil::take_precedence() : "";
  if (!forbidden.empty()) say("commands may be late, as it gets no real-time priority: " + forbidden);
  while (spinner.poll(clock.now_ms())) {
    if (interrupt.noted()) throw Interrupted("");
    say(spinner.words());
    if (spinner.lockstep()) {
      clock.wait(hil::Clock::kNap_us);
    } else {
      clock.wait_a_ms();
    }
  }
  if (spinner.other_params()) say("the base sent other parameters than those of the robot file");
  recorder.close();
  return spinner.sweep();
}

using planning::SquarePlanner;
using planning::StraightPlanner;

std::vector<std::string_view> mission_names() {
  return {"spin", "straight", "tape", "square-left", "square-right"};
}

CalibrationMission::CalibrationMission(std::string mission, double length_m)
    : mission_(std::move(mission)),
      length_(millimetres(static_cast<std::int32_t>(std::lround(length_m * 1e3)))) {}

planning::Planner& CalibrationMission::make(const Params& params) noexcept {
  params_ = params;
  straight_ = nullptr;
  square_ = nullptr;
  if (mission_ == "spin") {
    take(std::make_shared<planning::SpinPlanner>(params_));
  } else if (mission_ == "straight" || mission_ == "tape") {
    const auto way = mission_ == "tape" ? StraightPlanner::Way::there : StraightPlanner::Way::there_and_back;
    straight_ = take(std::make_shared<StraightPlanner>(params_, length_, way));
  } else {
    square_ = take(std::make_shared<SquarePlanner>(
        length_, mission_ == "square-left" ? SquarePlanner::Side::left : SquarePlanner::Side::right));
  }
  return *planner_;
}

std::string CalibrationMission::found() const {
  if (straight_ != nullptr) {
    return fmt::format("drove {:.4f} m by its wheels", straight_->way().raw() * 1e-6);
  }
  if (square_ == nullptr) return "";
  return fmt::format("believed_x_m {:.4f}, believed_y_m {:.4f}", square_->missed().x.raw() * 1e-6,
                     square_->missed().y.raw() * 1e-6);
}

}  // namespace whisker::cli
