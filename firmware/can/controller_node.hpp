#pragma once

#include <stdint.h>

#include "firmware/can/heard.hpp"
#include "firmware/can/input_set.hpp"
#include "firmware/can/mission.hpp"
#include "firmware/can/node.hpp"
#include "firmware/can/operator_inbox.hpp"
#include "firmware/can/order_box.hpp"
#include "firmware/can/param_server.hpp"
#include "firmware/can/rules_server.hpp"

namespace whisker::can {

/// The node that decides. It steps on complete input sets only, and its answer carries their tick. It never
/// allocates or waits.
///
///   every millisecond:  node.poll(now);
///                       if (node.take_order(...)) ...;
///                       if (node.take_set(set)) { ...; node.answer(...); }
class ControllerNode final : public Node {
 public:
  /// rules: takes response tables from the base, and names the active one instead of the Identity; null:
  /// none. inbox: where the messages of an operator go; null: they are not handled. Both must outlive the
  /// node.
  ControllerNode(hal::CanPort& port, const Identity& identity, RulesServer* rules = nullptr,
                 OperatorInbox* inbox = nullptr) noexcept;

  /// Blocks as RulesServer::execute() if the base orders another response table.
  void poll(uint32_t now_ms) noexcept;

  /// An order of the base was accepted since the last call. `mission` is unused for a cancel.
  bool take_order(Order& order, Mission& mission) noexcept;
  /// An order of the operator was accepted since the last call: call it before take_order. start and resume
  /// drive to the goal from where the robot is, start with the parameters that hold now.
  bool take_operator_order(Order& order, planning::Goal& goal) noexcept;
  /// The next complete input set while the robot runs: each once, and never an older one.
  bool take_set(InputSet& set) noexcept;
  /// The wheels were commanded to brake since the last answer: planned speeds must start at zero.
  bool braked() const noexcept { return braked_; }
  /// The answer to the last set. In lockstep it is stored and sent again on request.
  void answer(hal::WheelSpeeds speeds, const NavStatus& status) noexcept;
  /// Call it before answer(). Sends the report every 50 ticks, when its level changes, and if this tick ends
  /// the mission.
  void publish_trust(const RangeTrustReport& trust, bool ends) noexcept;
  /// Likewise, without a level.
  void publish_sigma(const PoseSigmaReport& sigma, bool ends) noexcept;

  /// The answer to the fix of the last set. Call it before answer(), which sends it.
  void answer_fix(const FixReply& reply) noexcept;

  /// Tells the operator; not part of the answer.
  void publish_guard(const GuardReport& report) noexcept {
    if (state() != NodeState::off_bus) send(report, kLife_ms);
  }

  /// From now on it accepts orders to calibrate.
  void accept_calibrations() noexcept { calibrates_ = true; }
  /// From now on it accepts orders of the operator.
  void accept_operator_orders() noexcept { takes_operator_ = true; }
  /// Tells the base, at any time; the node sets the mission.
  void publish_calibration(CalibrationReport report) noexcept;

  /// Parameters accepted by a commit.
  const Params& params() const noexcept { return server_.committed(); }
  /// Number of accepted commits, modulo 2^32.
  uint32_t commits() const noexcept { return server_.commits(); }
  /// The parameters until a commit, instead of the defaults; check() accepts them.
  void begin_with(const Params& params) noexcept { server_.set(params); }

 private:
  FrameResult on_frame(MessageKind kind, const hal::CanFrame& frame) noexcept override;
  void reset_peer() noexcept override;
  bool at_rest() const noexcept override { return true; }
  /// Before its first step the robot has not moved, and the sync mode is unknown.
  bool timed() const noexcept override { return !lockstep() && stepped_; }
  template <MessageKind kKind>
  bool on_range(int beam, const hal::CanFrame& frame) noexcept;
  bool on_fix(const hal::CanFrame& frame) noexcept;
  FrameResult on_operator(MessageKind kind, const hal::CanFrame& frame) noexcept;
  void on_wheels(const WheelState& state) noexcept {
    sets_.on_frame(state);
    heard_.wheels(state, now_ms());
  }
  void on_sync(const Sync& sync) noexcept;
  bool on_mission(const hal::CanFrame& frame, Requester who) noexcept;
  void on_param(const ParamRequest& request, Requester who) noexcept;
  void on_rules(const RulesPart& part) noexcept;
  void on_rules(const RulesOrder& order) noexcept;
  void execute_rules() noexcept;
  /// Why no response table is taken now; receiving: it is.
  RulesStatus hindrance() const noexcept;
  void announce_rules() noexcept;
  MissionStatus execute(const MissionOrder& order) noexcept;
  MissionStatus execute_operator(const MissionOrder& order) noexcept;
  /// Nothing is to be done, and the wheels stand.
  bool idle() const noexcept;
  bool operator_silent() const noexcept { return !operator_heard_ || now_ms() - operator_at_ > kPeerLost_ms; }
  void watch() noexcept;
  void lose_operator() noexcept;
  void brake() noexcept;
  void repeat_answer() noexcept;

  RulesServer* const rules_;
  RulesOrder rules_order_;
  RulesReply rules_reply_;
  bool rules_ordered_ = false;  // rules_order_ is to be executed
  bool rules_replies_ = false;  // rules_reply_ is to be sent
  OperatorInbox* const inbox_;
  InputSets sets_;
  uint32_t tick_ = 0;     // of the last set
  bool stepped_ = false;  // a set was taken in this mission
  bool answered_ = false;
  bool asked_again_ = false;
  RangeLevel published_ = RangeLevel::trusted;
  WheelCommand command_;
  NavStatus status_;
  FixReply fix_reply_;
  bool fix_answered_ = false;  // by fix_reply_, in the answer to the last set

  Heard heard_;
  uint32_t braked_at_ = 0;
  bool holding_ = false;
  bool braked_ = false;

  OrderBox<Mission> orders_;
  bool has_mission_ = false;
  bool calibrates_ = false;
  bool calibrating_ = false;  // the robot was placed by an order to calibrate

  OrderBox<planning::Goal> operator_orders_;
  uint32_t operator_at_ = 0;
  bool operator_heard_ = false;  // at operator_at_
  bool takes_operator_ = false;

  ParamServer server_;
};

}  // namespace whisker::can
