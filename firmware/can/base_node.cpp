#include "firmware/can/base_node.hpp"

#include "firmware/can/braking.hpp"

namespace whisker::can {
BaseNode::BaseNode(hal::CanPort& port, const Identity& identity, int16_t ramp) noexcept
    : Node(port, Party::base, identity), ramp_(ramp) {}

void BaseNode::poll(uint32_t now) noexcept {
  listen(now);
  if (ordered() && now - command_seen_ > kCommandLate_ms) stop(Error::command_late);
  publish();
  if (order_state_ == OrderState::waiting && permanent_errors() != 0) order_state_ = OrderState::refused;
  if (order_state_ != OrderState::waiting || !matched() || !at_rest()) return;
  if (order_due_ || now - ordered_at_ >= kOrderRepeat_ms) send_order();
}

bool BaseNode::send_set(const InputSet& set, SyncMode sync_mode) noexcept {
  set_sync_mode(sync_mode);
  tick_ = set.tick;
  period_ms_ = set.period_ms;
  const auto tick16 = static_cast<uint16_t>(set.tick);
  const hal::RangeReading* beam = set.ranges.beam;
  bool taken = true;
  const auto range = [&](auto frame, int at) {
    frame.reading = InputSets::to_wire(beam[at]);
    frame.tick = tick16;
    frame.bump = set.bumps[at];
    taken = send(frame, kLife_ms) && taken;
  };
  range(Range<MessageKind::range_left>{}, hal::kLeft);
  range(Range<MessageKind::range_front>{}, hal::kFront);
  range(Range<MessageKind::range_right>{}, hal::kRight);
  WheelState wheels;
  wheels.valid = set.counts_valid ? 1 : 0;
  wheels.tick = static_cast<uint8_t>(set.tick % WheelState::kTickModulus);
  wheels.counts = set.counts;
  taken = send(wheels, kLife_ms) && taken;
  Sync sync{sync_mode, set.tick, set.period_ms, mission_};
  if (set.has_gyro) {
    sync.gyro = 1;
    taken = send(GyroState{static_cast<uint8_t>(set.gyro_valid ? 1 : 0), wheels.tick, set.gyro}, kLife_ms) &&
            taken;
  }
  if (set.has_fix) {
    sync.fix = 1;
    const FixValues fix = values_of(set.fix);
    for (int i = 0; i < kFixValues; ++i) {
      taken = send(FixValue{static_cast<FixPart>(i), tick16, fix.of[i]}, kLife_ms) && taken;
    }
  }
  taken = send(sync, kLife_ms) && taken;
  flush();
  return taken;
}

hal::WheelSpeeds BaseNode::control() noexcept {
  if (running() && commanded_ && command_.mode == DriveMode::drive) {
    speeds_ = command_.speeds;
  } else {
    speeds_ = slowed(speeds_, ramp_);
  }
  return speeds_;
}

bool BaseNode::answered(uint32_t tick) const noexcept {
  const auto tick16 = static_cast<uint16_t>(tick);
  return commanded_ && command_.mode == DriveMode::drive && command_.tick == tick16 && status_come_ &&
         status_.tick == tick16;
}

void BaseNode::give(Order order, const Mission& mission, SyncMode sync_mode) noexcept {
  set_sync_mode(sync_mode);
  order_ = order;
  values_ = values_of(mission);
  mission_ = static_cast<uint8_t>(mission_ + 1);
  order_state_ = OrderState::waiting;
  order_due_ = true;
  commanded_ = false;
  status_come_ = false;
  fix_replied_ = false;
  calibration_seen_ = 0;
  rest();
  release();
}

void BaseNode::send_order() noexcept {
  bool taken = true;
  for (int i = 0; i < kMissionValues && taken; ++i) {
    taken = send(MissionValue{static_cast<MissionPart>(i + 1), mission_, values_.of[i]});
  }
  taken = taken && send(MissionOrder{MissionPart::order, mission_, order_, digest_of(values_)});
  order_due_ = !taken;
  ordered_at_ = now_ms();
}

void BaseNode::request(const ParamRequest& request) noexcept {
  replied_ = false;
  send(request);
}

bool BaseNode::replied(ParamReply& reply) const noexcept {
  if (replied_) reply = reply_;
  return replied_;
}

bool BaseNode::take(RulesReply& reply) noexcept {
  if (!rules_replied_) return false;
  rules_replied_ = false;
  reply = rules_reply_;
  return true;
}

bool BaseNode::reported(RangeTrustReport& trust) const noexcept {
  if (trust_come_) trust = trust_;
  return trust_come_;
}

bool BaseNode::reported(PoseSigmaReport& sigma) const noexcept {
  if (sigma_come_) sigma = sigma_;
  return sigma_come_;
}

bool BaseNode::replied(FixReply& reply) const noexcept {
  if (fix_replied_) reply = fix_reply_;
  return fix_replied_;
}

FrameResult BaseNode::on_frame(MessageKind kind, const hal::CanFrame& frame) noexcept {
  switch (kind) {
    case MessageKind::wheel_command:
      return read<WheelCommand>(frame, [this](const auto& m) { on_command(m); });
    case MessageKind::mission_reply: return read<MissionReply>(frame, [this](const auto& m) { on_reply(m); });
    case MessageKind::nav_status:
      return read<NavStatus>(frame, [this](const auto& m) {
        status_ = m;
        status_come_ = true;
      });
    case MessageKind::range_trust:
      return read<RangeTrustReport>(frame, [this](const auto& m) {
        trust_ = m;
        trust_come_ = true;
      });
    case MessageKind::pose_sigma:
      return read<PoseSigmaReport>(frame, [this](const auto& m) {
        sigma_ = m;
        sigma_come_ = true;
      });
    case MessageKind::fix_reply:
      return read<FixReply>(frame, [this](const auto& m) {
        fix_reply_ = m;
        fix_replied_ = true;
      });
    case MessageKind::param_reply:
      return read<ParamReply>(frame, [this](const auto& m) {
        if (m.to_operator != 0) return;
        reply_ = m;
        replied_ = true;
      });
    case MessageKind::guard_status: return read<GuardReport>(frame, [](const auto&) {});  // for the operator
    case MessageKind::rules_reply:
      return read<RulesReply>(frame, [this](const auto& m) {
        rules_reply_ = m;
        rules_replied_ = true;
      });
    case MessageKind::calibration:
      return read<CalibrationReport>(frame, [this](const auto& m) { on_report(m); });
    default: return FrameResult::unknown;
  }
}

/// Reports of an earlier mission do not count.
void BaseNode::on_report(const CalibrationReport& report) noexcept {
  if (order_state_ != OrderState::accepted || report.mission != mission_ ||
      report.trouble == planning::Trouble::not_finished) {
    return;
  }
  calibration_.of[static_cast<int>(report.quantity)] = {static_cast<int32_t>(report.value),
                                                        Ratio::from_raw(report.sigma)};
  calibration_.trouble = report.trouble;
  calibration_.stored = report.stored;
  calibration_seen_ = static_cast<uint8_t>(calibration_seen_ | 1U << static_cast<unsigned>(report.quantity));
}

bool BaseNode::calibrated(Calibrated& result) const noexcept {
  if (calibration_seen_ != (1U << calibration::kQuantities) - 1) return false;
  result = calibration_;
  return true;
}

void BaseNode::on_command(const WheelCommand& command) noexcept {
  const auto behind = static_cast<uint16_t>(tick_ - command.tick);
  if (command.mode == DriveMode::drive && behind * period_ms_ > (lockstep() ? 0U : kCommandOld_ms)) {
    count(tally().stale);
    return;
  }
  command_ = command;
  commanded_ = true;
  command_seen_ = now_ms();
}

void BaseNode::on_reply(const MissionReply& reply) noexcept {
  if (reply.to_operator != 0 || reply.mission != mission_ || order_state_ != OrderState::waiting) return;
  order_status_ = reply.status;
  switch (reply.status) {
    case MissionStatus::accepted:
      order_state_ = OrderState::accepted;
      if (!drives(order_)) break;
      command_seen_ = now_ms();
      if (!run()) order_state_ = OrderState::refused;
      break;
    case MissionStatus::incomplete: order_due_ = true; break;
    case MissionStatus::refused:
    case MissionStatus::out_of_range:
    case MissionStatus::unsupported:
    case MissionStatus::unknown: order_state_ = OrderState::refused; break;
  }
}

void BaseNode::reset_peer() noexcept {
  commanded_ = false;
  status_come_ = false;
  trust_come_ = false;
  sigma_come_ = false;
  fix_replied_ = false;
  calibration_seen_ = 0;
  replied_ = false;
}

}  // namespace whisker::can
