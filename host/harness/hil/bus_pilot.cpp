#include "host/harness/hil/bus_pilot.hpp"

#include <fmt/format.h>

#include "firmware/apps/can/base.hpp"
#include "firmware/fuzzy/digest.hpp"
#include "firmware/localization/odometry.hpp"
#include "host/harness/hil/bus_talk.hpp"
#include "host/harness/hil/error_names.hpp"
#include "host/harness/hil/operator_orders.hpp"
#include "host/harness/hil/overheard.hpp"
#include "host/harness/hil/resend.hpp"
#include "host/harness/run/fix_source.hpp"
#include "host/harness/run/link_loss.hpp"
#include "host/harness/run/spec.hpp"
#include "host/harness/sim/sim_board.hpp"

namespace whisker::hil {
namespace {

/// Ticks start at whole milliseconds, because waits end there.
std::uint64_t whole_ms(std::uint64_t us) { return us - us % 1000; }

class BusPilot final : public Pilot {
 public:
  BusPilot(hal::CanPort& port, Clock& clock, const BusOptions& options, Figures& figures,
           const Scenario& scenario, sim::Plant& plant)
      : clock_(clock),
        options_(options),
        figures_(figures),
        params_(scenario.robot),
        rules_(options.rules),
        table_(options.table),
        mission_{fixed_pose(scenario.start), options.goal ? *options.goal : fixed_goal(scenario.goal)},
        period_us_(static_cast<std::uint64_t>(scenario.robot.safety.period.raw()) * 1000),
        resend_(std::uint64_t{options.resend_ms} * 1000),
        plant_(plant),
        fixes_(scenario),
        reckons_(params_.gyro.fitted == Fitted::no && params_.walls.straight == Fitted::no &&
                 !(scenario.noise.fix_every_m > 0) && scenario.events.empty()),
        loss_(params_),
        operator_(port, options.identity.robot),
        board_(plant),
        node_(operator_.port(), options.identity, braking_step(scenario.robot)),
        base_(node_, board_, board_, params_.bumper.fitted == Fitted::yes ? &board_ : nullptr,
              params_.gyro.fitted == Fitted::yes ? &board_ : nullptr) {
    odometry_.configure(params_);
    odometry_.place(mission_.start);
  }

  ~BusPilot() override {
    node_.give(can::Order::cancel, mission_, options_.sync_mode);
    for (int i = 0; i < 100 && node_.order_state() == can::OrderState::waiting; ++i) talk_.nap();
    figures_.health = node_.health();
  }

  const Status& tick(Time now) override {
    const auto period_ms = static_cast<std::uint8_t>(period_us_ / 1000);
    try {
      if (!begun_) begin();
      auto fix = fixes_.take(plant_);
      if (!regain()) return away(now.raw() / period_ms);
      if (fix_) fix = fix_;
      fix_.reset();
      if (fix) {
        base_.correct(*fix);
        ++figures_.fixes;
      }
      base_.measure(now.raw() / period_ms, period_ms);
      reckon();
      ++figures_.sets;
      status_ = talk_.lockstep() ? in_lockstep(now.raw() / period_ms) : in_time(now.raw() / period_ms);
      await_calibration();
    } catch (const Hopeless&) {
    }
    look_inside();
    status_.command = base_.drive();
    take_reports();
    figures_.run_s = static_cast<double>(figures_.sets * period_us_) * 1e-6;
    if (begun_) figures_.wall_s = static_cast<double>(clock_.now_us() - begun_us_) * 1e-6;
    return status_;
  }

  bool play(const Event& e) override {
    switch (e.kind) {
      case EventKind::goal: return aim(fixed_goal(e.goal));
      case EventKind::cancel: return begun_ && order(can::Order::cancel, mission_.goal);
      case EventKind::correct: fix_ = fix_of(e, plant_.pose()); return true;
      case EventKind::param: return change(apply_param(e, params_));
      case EventKind::table: return change(choose_table(e));
      case EventKind::frames_lost:
        // In lockstep, time does not pass while a set is repeated.
        if (!talk_.lockstep() || loss_.stops(e.for_s)) loss_.lose(e.for_s);
        return true;
      case EventKind::restart: return restart();
      case EventKind::place:
      case EventKind::reset: break;
    }
    return false;
  }
  bool hears() const override { return !loss_.lost(); }

  bool sees_inside() const override { return options_.shadow != nullptr; }
  const perception::LocalGrid* local_grid() const override {
    return sees_inside() ? options_.shadow->local_grid() : nullptr;
  }
  const RecordingGuide* guide() const override { return sees_inside() ? options_.shadow->guide() : nullptr; }
  /// With a gyro or fixes, only the controller knows its estimate.
  std::optional<Pose> estimate() const override {
    return reckons_ ? std::optional(odometry_.pose()) : std::nullopt;
  }

  std::optional<RangeTrust> ranges() const override {
    can::RangeTrustReport report;
    if (!node_.reported(report)) return std::nullopt;
    const auto share = [](std::uint8_t part) { return static_cast<std::uint16_t>(part << 8); };
    return RangeTrust{report.level, report.contradictions, share(report.phantoms), share(report.false_clears),
                      report.incidence};
  }

  std::optional<localization::PoseSigma> sigma() const override {
    can::PoseSigmaReport report;
    if (!node_.reported(report)) return std::nullopt;
    return localization::PoseSigma{millimetres(report.along), millimetres(report.across),
                                   Angle::from_raw(std::uint32_t{report.heading} << 16)};
  }

  const char* trouble() const override {
    if (node_.state() == can::NodeState::e_stopped) return "e_stop";
    if (const std::uint16_t bits = node_.permanent_errors(); bits != 0) {
      return (bits & can::Error::duplicate_node) != 0 ? "duplicate_node" : "bus_off_latched";
    }
    return talk_.lockstep() && node_.state() == can::NodeState::safe_stop ? "safe_stop" : nullptr;
  }

 private:
  static constexpr Duration kLongestPause = milliseconds(1000);

  /// Computes the estimate from the frames, because the bus does not carry the core's. After a pause, the
  /// wheels may have rolled farther than in one period.
  void reckon() {
    hal::EncoderCounts counts{};
    localization::CountStep step;
    if (board_.read(counts)) odometry_.update(counts, kLongestPause, step);
  }

  bool restart() {
    loss_.restart();
    status_.decision.outcome = planning::Outcome::running;
    status_.health = {};
    return true;
  }

  bool aim(const planning::Goal& goal) {
    if (begun_ && !changed_ && !order(can::Order::resume, goal)) return false;
    mission_.goal = goal;
    return !changed_ || restart();
  }

  bool choose_table(const Event& event) {
    const auto* const table = event.file.empty() ? &fuzzy::kResponseTable : event.table;
    if (!rules_ || table == nullptr) return false;
    table_ = table;
    rules_ = fuzzy::digest(*table);
    return true;
  }

  bool change(bool changed) {
    changed_ = changed_ || changed;
    return changed;
  }

  /// An operator's order: the base's own ones need wheels at rest.
  bool order(can::Order order, const planning::Goal& goal) {
    if (!talk_.running()) return false;
    talk_.ask_for("MissionReply to the operator");
    operator_.begin();
    while (!operator_.answered(order, goal, clock_.now_us())) {
      talk_.watchful_nap();
      talk_.watch_patience();
      if (!talk_.running()) return false;
    }
    return operator_.accepted();
  }

  /// False: the robot has no controller in this tick.
  bool regain() {
    switch (loss_.step(status_.command, plant_)) {
      case LinkLoss::Step::up:
      case LinkLoss::Step::back: return true;
      case LinkLoss::Step::hold: return false;
      case LinkLoss::Step::brake: {
        const bool restarts = loss_.restarts();
        // In real time, a loss stops both nodes by itself.
        if (!braking_ && (restarts || talk_.lockstep()))
          node_.give(restarts ? can::Order::cancel : can::Order::resume, mission_, options_.sync_mode);
        braking_ = true;
        return false;
      }
      case LinkLoss::Step::resume:
        if (talk_.lockstep()) talk_.give(can::Order::resume, mission_);
        break;
      case LinkLoss::Step::restart: start_anew(); break;
    }
    braking_ = false;
    return true;
  }

  const Status& away(std::uint32_t tick) {
    if (!talk_.lockstep()) in_time(tick, false);
    status_.command = base_.drive();
    return status_;
  }

  /// What a controller that has restarted gets: its table, the parameters, and the mission from where the
  /// robot stands.
  void start_anew() {
    talk_.give(can::Order::cancel, mission_);
    mission_.start = fixed_pose(plant_.pose());
    hand_over();
    talk_.give(can::Order::start, mission_);
    due_us_ = whole_ms(clock_.now_us());
  }

  void hand_over() {
    if (rules_) talk_.make_it_drive_with(*rules_, table_);
    talk_.hand_over(params_);
    changed_ = false;
  }

  /// Completes the status with what the bus does not carry. What decides remains the controller's word.
  void look_inside() {
    if (!sees_inside()) return;
    Shadow& shadow = *options_.shadow;
    const bool alike = shadow.difference().empty();
    status_.pose = mission_.start;
    if (!shadow.follow()) return;
    if (alike && !shadow.difference().empty())
      options_.say(
          fmt::format("what is inside the controller is not known any more: {}", shadow.difference()));
    const Status told = status_;
    status_ = shadow.status();
    status_.decision.outcome = told.decision.outcome;
    status_.decision.mode = told.decision.mode;
    status_.decision.why = told.decision.why;
    status_.health.fault = told.health.fault;
  }

  void take_reports() {
    if (!sees_inside()) {
      const auto known = sigma();
      status_.sigma_known = known.has_value();
      if (known) status_.sigma = *known;
    }
    can::FixReply reply;
    if (!node_.replied(reply)) return;
    status_.health.fix_jumps = reply.jumps;
    status_.health.fixes_refused = reply.refused;
    if (answered_fix_ == reply.tick) return;
    answered_fix_ = reply.tick;
    ++(reply.status == can::FixStatus::accepted ? figures_.fixes_accepted : figures_.fixes_refused);
  }

  void begin() {
    while (!node_.matched()) talk_.watchful_nap();
    talk_.count_restarts();
    hand_over();
    talk_.give(options_.order, mission_);
    begun_ = true;
    begun_us_ = clock_.now_us();
    due_us_ = whole_ms(begun_us_);
  }

  /// The controller saves, which may take seconds, and reports in turn.
  void await_calibration() {
    if (!calibrates(options_.order) || figures_.calibrated ||
        status_.decision.outcome == planning::Outcome::running || status_.health.fault != Fault::none)
      return;
    const bool drove = status_.decision.outcome == planning::Outcome::reached;
    if (options_.order == can::Order::tape && drove) talk_.give(can::Order::measured, read_tape());
    talk_.ask_for("Calibration report");
    can::Calibrated found;
    while (!node_.calibrated(found)) {
      talk_.watchful_nap();
      talk_.watch_patience();
    }
    figures_.calibrated = found;
  }

  /// What a person does after a drive along a tape.
  can::Mission read_tape() const {
    return {mission_.start, {fixed_pose(plant_.pose()).at, mission_.goal.tolerance}};
  }

  Status in_lockstep(std::uint32_t tick) {
    const std::uint64_t sent_us = clock_.now_us();
    base_.publish(can::SyncMode::lockstep);
    resend_.sent(sent_us);
    talk_.ask_for("WheelCommand and NavStatus");
    while (talk_.running() || node_.state() == can::NodeState::waiting ||
           node_.state() == can::NodeState::off_bus) {
      // The answer may arrive together with the loss of the controller; then it drives nothing.
      if (talk_.running() && node_.answered(tick)) {
        const std::uint64_t now_us = clock_.now_us();
        resend_.answered(now_us);
        figures_.round_trip_us.push_back(static_cast<std::uint32_t>(now_us - sent_us));
        return status_of(node_.status());
      }
      clock_.wait(Clock::kNap_us);
      const std::uint64_t now_us = clock_.now_us();
      node_.poll(static_cast<std::uint32_t>(now_us / 1000));
      talk_.check();
      talk_.watch_patience();
      if (!talk_.running() || node_.answered(tick) || !resend_.due(now_us)) continue;
      base_.publish(can::SyncMode::lockstep);
      ++figures_.resent;
      resend_.sent_again(now_us);
    }
    talk_.explain();
    return status_;
  }

  /// sends: otherwise, the set of this tick is lost.
  Status in_time(std::uint32_t tick, bool sends = true) {
    const std::uint64_t sent_us = clock_.now_us();
    if (sent_us > due_us_ + period_us_) {
      ++figures_.late;
      due_us_ = whole_ms(sent_us);
    }
    due_us_ += period_us_;
    if (sends) base_.publish(can::SyncMode::real_time);
    node_.poll(clock_.now_ms());
    bool answered = false;
    while (clock_.now_us() < due_us_) {
      clock_.wait_a_ms();
      node_.poll(clock_.now_ms());
      if (!answered && node_.answered(tick)) {
        answered = true;
        figures_.round_trip_us.push_back(static_cast<std::uint32_t>(clock_.now_us() - sent_us));
      }
    }
    if (!answered) ++figures_.misses;
    talk_.check();
    if (sends) resume();
    return answered ? status_of(node_.status()) : status_;
  }

  /// Resumes after a safe stop whose cause is gone, so that the mission continues.
  void resume() {
    if (resuming_ && node_.order_state() == can::OrderState::accepted) ++figures_.resumed;
    if (node_.order_state() == can::OrderState::waiting) return;
    resuming_ = false;
    const bool stopped = node_.state() == can::NodeState::safe_stop || node_.state() == can::NodeState::ready;
    if (!stopped || !node_.matched()) return;
    node_.give(can::Order::resume, mission_, options_.sync_mode);
    resuming_ = true;
  }

  Clock& clock_;
  const BusOptions options_;
  Figures& figures_;
  Params params_;  // of the next start
  std::optional<std::uint32_t> rules_;
  const can::RulesServer::Table* table_;
  can::Mission mission_;
  const std::uint64_t period_us_;
  Resend resend_;
  sim::Plant& plant_;
  FixSource fixes_;
  const bool reckons_;  // the estimate can be computed from the frames
  LinkLoss loss_;
  OperatorOrders operator_;
  std::optional<localization::UncertainPose> fix_;
  bool changed_ = false;  // since the last start: the parameters, or the table
  bool braking_ = false;
  hal::SimBoard board_;
  can::BaseNode node_;
  BusTalk talk_{clock_, options_, node_};
  can_app::Base base_;
  localization::Odometry odometry_;
  Status status_;
  std::uint64_t begun_us_ = 0;
  std::uint64_t due_us_ = 0;
  std::optional<std::uint16_t> answered_fix_;  // its tick
  bool begun_ = false;
  bool resuming_ = false;
};

}  // namespace

MakePilot bus_pilot(hal::CanPort& port, Clock& clock, const BusOptions& options, Figures& figures) {
  return [&port, &clock, options, &figures](const Scenario& scenario, PlannerKind, sim::Plant& plant) {
    return std::make_unique<BusPilot>(port, clock, options, figures, scenario, plant);
  };
}

}  // namespace whisker::hil
