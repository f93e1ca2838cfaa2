#include "firmware/can/controller_node.hpp"

namespace whisker::can {
namespace {

constexpr uint32_t kReportTicks = 50;
constexpr Length kShortestStraight = 499_mm;

}  // namespace

ControllerNode::ControllerNode(hal::CanPort& port, const Identity& identity, RulesServer* rules,
                               OperatorInbox* inbox) noexcept
    : Node(port, Party::controller, identity), rules_(rules), inbox_(inbox) {
  if (rules_ != nullptr) set_rules(rules_->hash());
}

void ControllerNode::poll(uint32_t now) noexcept {
  listen(now);
  if (rules_replies_) {
    send(rules_reply_);
    rules_replies_ = false;
  }
  if (operator_heard_ && operator_silent()) lose_operator();
  watch();
  publish();
  if (asked_again_) repeat_answer();
  const bool drives = running() && !holding_;
  if (!drives && !lockstep() && matched() && now - braked_at_ >= kStopRepeat_ms) brake();
  if (rules_ordered_) execute_rules();
}

/// The counters of another operator, or of one that restarted, are not compared with those of this one.
void ControllerNode::lose_operator() noexcept {
  operator_heard_ = false;
  operator_orders_.forget_number();
  operator_orders_.forget_parts();
  server_.drop(Requester::third_party);
  forget_operator();
}

void ControllerNode::watch() noexcept {
  holding_ = false;
  if (!ordered() || !timed()) return;
  holding_ = heard_.holds(now_ms());
  if (heard_.lost_beam(now_ms())) stop(Error::range_late);
  if (heard_.lost_counts(now_ms())) stop(Error::odometry_late);
}

void ControllerNode::brake() noexcept {
  WheelCommand command;
  command.tick = static_cast<uint16_t>(tick_);
  if (!send(command, kLife_ms)) return;
  braked_at_ = now_ms();
  braked_ = true;
}

void ControllerNode::repeat_answer() noexcept {
  asked_again_ = false;
  send(command_, kLife_ms);
  send(status_, kLife_ms);
  if (fix_answered_) send(fix_reply_);
}

bool ControllerNode::take_order(Order& order, Mission& mission) noexcept {
  return orders_.take(order, mission);
}

bool ControllerNode::take_operator_order(Order& order, planning::Goal& goal) noexcept {
  return operator_orders_.take(order, goal);
}

bool ControllerNode::take_set(InputSet& set) noexcept {
  if (!running() || !orders_.taken() || !sets_.complete()) return false;
  const InputSet next = sets_.set();
  const uint32_t ahead = next.tick - tick_;
  if (stepped_ && (ahead == 0 || ahead > INT32_MAX || (lockstep() && ahead != 1))) return false;
  for (uint32_t i = 1; stepped_ && i < ahead && i < kKinds; ++i) count(tally().skipped);
  tick_ = next.tick;
  stepped_ = true;
  answered_ = false;
  fix_answered_ = false;
  heard_.set(now_ms());
  set = next;
  return true;
}

void ControllerNode::answer(hal::WheelSpeeds speeds, const NavStatus& status) noexcept {
  command_ = {DriveMode::drive, speeds, static_cast<uint16_t>(tick_)};
  status_ = status;
  status_.tick = static_cast<uint16_t>(tick_);
  answered_ = true;
  braked_ = false;
  repeat_answer();
  flush();
}

void ControllerNode::publish_trust(const RangeTrustReport& trust, bool ends) noexcept {
  if (!ends && trust.level == published_ && tick_ % kReportTicks != 0) return;
  if (send(trust)) published_ = trust.level;
}

void ControllerNode::publish_sigma(const PoseSigmaReport& sigma, bool ends) noexcept {
  if (ends || tick_ % kReportTicks == 0) send(sigma);
}

void ControllerNode::publish_calibration(CalibrationReport report) noexcept {
  report.mission = orders_.number();
  if (state() != NodeState::off_bus) send(report);
}

void ControllerNode::answer_fix(const FixReply& reply) noexcept {
  fix_reply_ = reply;
  fix_reply_.tick = static_cast<uint16_t>(tick_);
  fix_answered_ = true;
}

FrameResult ControllerNode::on_frame(MessageKind kind, const hal::CanFrame& frame) noexcept {
  if (is_operator(frame.id & 0x0F, kind)) return on_operator(kind, frame);
  switch (kind) {
    case MessageKind::range_left: return in_range(on_range<MessageKind::range_left>(hal::kLeft, frame));
    case MessageKind::range_front: return in_range(on_range<MessageKind::range_front>(hal::kFront, frame));
    case MessageKind::range_right: return in_range(on_range<MessageKind::range_right>(hal::kRight, frame));
    case MessageKind::wheel_state: return read<WheelState>(frame, [this](const auto& m) { on_wheels(m); });
    case MessageKind::gyro: return read<GyroState>(frame, [this](const auto& m) { sets_.on_frame(m); });
    case MessageKind::fix: return in_range(on_fix(frame));
    case MessageKind::sync: return read<Sync>(frame, [this](const auto& m) { on_sync(m); });
    case MessageKind::mission: return in_range(on_mission(frame, Requester::base));
    case MessageKind::param_request:
      return read<ParamRequest>(frame, [this](const auto& m) { on_param(m, Requester::base); });
    case MessageKind::rules_part: return read<RulesPart>(frame, [this](const auto& m) { on_rules(m); });
    case MessageKind::rules_order: return read<RulesOrder>(frame, [this](const auto& m) { on_rules(m); });
    default: return FrameResult::unknown;
  }
}

/// An operator that appears needs the Info, to compare the table.
FrameResult ControllerNode::on_operator(MessageKind kind, const hal::CanFrame& frame) noexcept {
  const bool for_guard = kind == MessageKind::velocity || kind == MessageKind::vouch;
  if (for_guard && inbox_ == nullptr) return FrameResult::unknown;
  if (operator_silent()) announce();
  operator_heard_ = true;
  operator_at_ = now_ms();
  switch (kind) {
    case MessageKind::velocity:
      return read<VelocityCommand>(frame, [this](const auto& m) { inbox_->on_frame(m, now_ms()); });
    case MessageKind::vouch: return read<VouchRequest>(frame, [this](const auto& m) { inbox_->on_frame(m); });
    case MessageKind::mission: return in_range(on_mission(frame, Requester::third_party));
    case MessageKind::param_request:
      return read<ParamRequest>(frame, [this](const auto& m) { on_param(m, Requester::third_party); });
    default: return FrameResult::unknown;
  }
}

template <MessageKind kKind>
bool ControllerNode::on_range(int beam, const hal::CanFrame& frame) noexcept {
  Range<kKind> range;
  if (!decode(frame, range) || !InputSets::sound(range.reading)) return false;
  sets_.on_frame(beam, range.reading, range.tick, range.bump);
  heard_.beam(beam, now_ms());
  return true;
}

bool ControllerNode::on_fix(const hal::CanFrame& frame) noexcept {
  FixValue part;
  return decode(frame, part) && sets_.on_frame(part);
}

void ControllerNode::on_sync(const Sync& sync) noexcept {
  if (!orders_.is_of(sync.mission)) {
    count(tally().stale);
    return;
  }
  set_sync_mode(sync.sync_mode);
  sets_.on_frame(sync);
  asked_again_ = lockstep() && answered_ && sync.tick == tick_;
}

bool ControllerNode::on_mission(const hal::CanFrame& frame, Requester who) noexcept {
  const bool of_base = who == Requester::base;
  MissionValue part;
  if (!decode(frame, part)) return false;
  if (part.part != MissionPart::order) {
    if (of_base) {
      orders_.on_frame(part);
    } else {
      operator_orders_.on_frame(part);
    }
    return true;
  }
  MissionOrder order;
  if (!decode(frame, order)) return false;
  const MissionStatus status = of_base ? execute(order) : execute_operator(order);
  send(MissionReply{status, order.mission, static_cast<uint8_t>(of_base ? 0 : 1)});
  return true;
}

MissionStatus ControllerNode::execute(const MissionOrder& order) noexcept {
  if (!orders_.complete(order)) return MissionStatus::incomplete;
  if (orders_.is_of(order.mission)) return MissionStatus::accepted;
  Mission mission;
  if (!mission_of(orders_.values(), mission)) return MissionStatus::out_of_range;
  if (order.order == Order::resume && !has_mission_) return MissionStatus::unknown;
  if (calibrates(order.order) && !calibrates_) return MissionStatus::unsupported;
  const bool has_length = calibrates(order.order) && order.order != Order::spin;
  if (has_length && !farther(mission.goal.at - mission.start.at, kShortestStraight)) {
    return MissionStatus::out_of_range;
  }
  if (!drives(order.order)) {
    rest();
    has_mission_ = false;
  } else {
    set_sync_mode(SyncMode::real_time);
    if (!run()) return MissionStatus::refused;
    has_mission_ = true;
    if (order.order != Order::resume) calibrating_ = calibrates(order.order);
  }
  orders_.accept(order, mission);
  braked_ = order.order == Order::resume;
  sets_.forget();
  stepped_ = false;
  answered_ = false;
  asked_again_ = false;
  heard_.begin(now_ms());
  return MissionStatus::accepted;
}

/// The order of the base holds on: its sets, its clock and its right to drive are those of this order, too.
MissionStatus ControllerNode::execute_operator(const MissionOrder& order) noexcept {
  // Each order is executed before the next one is accepted.
  if (!operator_orders_.complete(order) || !operator_orders_.taken()) return MissionStatus::incomplete;
  if (operator_orders_.is_of(order.mission)) return MissionStatus::accepted;
  if (!takes_operator_ || calibrating_ || calibrates(order.order)) return MissionStatus::unsupported;
  Mission mission;
  if (!mission_of(operator_orders_.values(), mission)) return MissionStatus::out_of_range;
  if (!running() || !stepped_ || !answered_ || status_.fault != 0) return MissionStatus::refused;
  if (order.order == Order::start && !idle()) return MissionStatus::refused;
  operator_orders_.accept(order, mission.goal);
  return MissionStatus::accepted;
}

bool ControllerNode::idle() const noexcept {
  if (!ordered()) return true;
  const bool has_goal = inbox_ == nullptr && status_.outcome == planning::Outcome::running;
  const bool commanded = command_.speeds.left != 0 || command_.speeds.right != 0;
  return answered_ && operator_orders_.taken() && !has_goal && !commanded && heard_.stands(now_ms());
}

void ControllerNode::on_param(const ParamRequest& request, Requester who) noexcept {
  const bool base_transfers = !ordered() && server_.stager() == Requester::base;
  const bool busy = who == Requester::base ? ordered() : !idle() || base_transfers;
  send(server_.answer(request, who, busy));
}

RulesStatus ControllerNode::hindrance() const noexcept {
  if (rules_ == nullptr) return RulesStatus::unsupported;
  if (ordered()) return RulesStatus::running;
  if (!heard_.stands(now_ms())) return RulesStatus::moving;
  return RulesStatus::receiving;
}

void ControllerNode::on_rules(const RulesPart& part) noexcept {
  RulesReply reply{hindrance(), part.upload};
  if (reply.status == RulesStatus::receiving) reply = rules_->take(part);
  announce_rules();
  if (ends_block(part)) send(reply);
}

void ControllerNode::on_rules(const RulesOrder& order) noexcept {
  rules_order_ = order;
  rules_ordered_ = true;
}

/// May take seconds, after which the frames that wait in the port are stale. So it is the last step of a
/// poll, and the next one sends the reply.
void ControllerNode::execute_rules() noexcept {
  rules_ordered_ = false;
  rules_reply_ = {hindrance(), rules_order_.upload};
  if (rules_reply_.status == RulesStatus::receiving) rules_reply_ = rules_->execute(rules_order_);
  rules_replies_ = true;
  announce_rules();
}

void ControllerNode::announce_rules() noexcept {
  if (rules_ == nullptr || rules_->hash() == rules()) return;
  set_rules(rules_->hash());
  has_mission_ = false;
}

void ControllerNode::reset_peer() noexcept {
  if (rules_ != nullptr) rules_->forget();
  rules_ordered_ = false;
  rules_replies_ = false;
  sets_.forget();
  server_.drop(Requester::base);
  operator_orders_.drop();
  orders_.forget_parts();
  orders_.forget_number();
  orders_.drop();
  has_mission_ = false;
  stepped_ = false;
  answered_ = false;
  asked_again_ = false;
  set_sync_mode(SyncMode::real_time);
}

}  // namespace whisker::can
