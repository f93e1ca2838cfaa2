#include "firmware/can/node.hpp"

#include "firmware/can/table_hash.hpp"

namespace whisker::can {
namespace {

/// More than any port buffers. The limit keeps a babbling node from blocking this one.
constexpr int kMostFrames = 64;
constexpr uint16_t kLateness =
    Error::command_late | Error::odometry_late | Error::range_late | Error::peer_lost | Error::bus_off;
constexpr uint16_t kForGood = Error::bus_off_latched | Error::duplicate_node;

uint16_t at_most_16(uint32_t x) noexcept { return x > UINT16_MAX ? UINT16_MAX : static_cast<uint16_t>(x); }

}  // namespace

Node::Node(hal::CanPort& port, Party party, const Identity& identity) noexcept
    : port_(port),
      identity_(identity),
      party_(party),
      node_(node_of(identity.robot, party)),
      peer_node_(node_of(identity.robot, other(party))) {}

NodeState Node::state() const noexcept {
  if (e_stopped_) return NodeState::e_stopped;
  if (!guard_.on_bus()) return NodeState::off_bus;
  if (latched_ != 0) return NodeState::safe_stop;
  if (!matched_) return NodeState::waiting;
  return running_ ? NodeState::running : NodeState::ready;
}

uint16_t Node::errors() const noexcept {
  uint16_t bits = latched_ | standing_;
  if (e_stopped_) bits |= Error::e_stop;
  if (guard_.latched()) bits |= Error::bus_off_latched;
  const bool versions_differ = peer_.protocol != kProtocol || (hash_known_ && !hash_right_);
  if (peer_heard_ && versions_differ) bits |= Error::wrong_version;
  return bits;
}

uint16_t Node::permanent_errors() const noexcept {
  return static_cast<uint16_t>((errors() | (peer_heard_ ? peer_.errors : 0)) & kForGood);
}

void Node::report(uint16_t bits, uint8_t core_fault) noexcept {
  standing_ = bits;
  core_fault_ = core_fault;
}

void Node::stop(uint16_t error) noexcept {
  if (!timed() && (error & kLateness) != 0) return;
  if (running_) {
    count(health_.stops);
    running_ = false;
    latched_ |= error;
  }
  latched_ |= error & kForGood;
}

bool Node::run() noexcept {
  if (e_stopped_ || !matched_ || !guard_.on_bus() || (latched_ & kForGood) != 0) return false;
  latched_ = 0;
  running_ = true;
  return true;
}

void Node::set_rules(uint32_t hash) noexcept {
  identity_.rules = hash;
  announce_ = true;
}

void Node::release() noexcept { latched_ &= kForGood; }

void Node::press_e_stop() noexcept {
  send(EStop{});
  if (!e_stopped_) count(health_.stops);
  e_stopped_ = true;
  running_ = false;
}

void Node::listen(uint32_t now_ms) noexcept {
  now_ = now_ms;
  if (!begun_) {
    begun_ = true;
    started_ = said_at_ = fault_said_at_ = diagnosed_at_ = now_ms;
  }
  port_.poll(now_ms);
  guard_.watch(port_, now_ms);
  if (!guard_.on_bus()) stop(Error::bus_off);
  if (guard_.latched()) stop(Error::bus_off_latched);
  hal::CanFrame frame{};
  for (int i = 0; i < kMostFrames && port_.receive(frame); ++i) receive(frame);
  if (peer_heard_ && now_ - peer_seen_ > kPeerLost_ms) {
    stop(Error::peer_lost);
    lose_peer();
  }
}

bool Node::is_for_us(uint8_t node) const noexcept { return node == 0 || node == node_ || node == peer_node_; }

void Node::receive(const hal::CanFrame& frame) noexcept {
  MessageKind kind = MessageKind::e_stop;
  const auto node = static_cast<uint8_t>(frame.id & 0x0F);
  if (frame.id > 0x7FF || !is_for_us(node)) {
    count(health_.foreign);
  } else if (!kind_of(frame.id, kind)) {
    count(node == peer_node_ ? health_.unknown : health_.foreign);
  } else if (frame.extended || frame.remote) {
    count(health_.malformed);
  } else if (kind == MessageKind::e_stop) {
    receive_e_stop(frame);
  } else if (is_operator(node, kind)) {
    receive_from_operator(kind, frame);
  } else if (is_sound(kind, frame)) {
    if (node == node_ && kind == MessageKind::info_request) {
      // A survey asks the other node in the place of this one, which was silent then.
      count(health_.foreign);
    } else if (node == node_) {
      count(health_.duplicates);
      stop(Error::duplicate_node);
    } else if (node == peer_node_) {
      understand(kind, frame, heard_[static_cast<uint8_t>(kind)]);
    } else {
      count(health_.malformed);
    }
  }
}

void Node::receive_e_stop(const hal::CanFrame& frame) noexcept {
  count(health_.e_stops);
  EStop what;
  const bool whole = frame.size == head_of(MessageKind::e_stop).size &&
                     frame.data[0] == crc_of(frame.id, frame.data, frame.size) && decode(frame, what);
  if (whole && what.command == kClearCommand) {
    if (at_rest()) e_stopped_ = false;
    return;
  }
  if (!e_stopped_) count(health_.stops);
  e_stopped_ = true;
  running_ = false;
}

void Node::receive_from_operator(MessageKind kind, const hal::CanFrame& frame) noexcept {
  if (party_ == Party::base) {
    count(health_.foreign);
  } else if (is_whole(kind, frame, (frame.id & 0x0F) == node_)) {
    understand(kind, frame, heard_operator_[head_of(kind).operator_place]);
  }
}

bool Node::is_sound(MessageKind kind, const hal::CanFrame& frame) noexcept {
  const bool own = (frame.id & 0x0F) == node_;
  return is_whole(kind, frame, may_send(own ? party_ : other(party_), kind));
}

bool Node::is_whole(MessageKind kind, const hal::CanFrame& frame, bool allowed) noexcept {
  if (frame.size != head_of(kind).size || !allowed) {
    count(health_.malformed);
    return false;
  }
  if (frame.data[0] != crc_of(frame.id, frame.data, frame.size)) {
    count(health_.crc);
    return false;
  }
  return true;
}

void Node::understand(MessageKind kind, const hal::CanFrame& frame, AliveReceiver& alive) noexcept {
  uint8_t lost = 0;
  switch (alive.judge(counter_of(frame), lost)) {
    case Arrival::repeated: count(health_.repeated); return;
    case Arrival::out_of_sequence: count(health_.out_of_sequence); return;
    case Arrival::in_turn: break;
  }
  for (; lost > 0; --lost) count(health_.lost);
  FrameResult heard = FrameResult::understood;
  switch (kind) {
    case MessageKind::heartbeat:
      heard = read<Heartbeat>(frame, [this](const Heartbeat& m) { on_heartbeat(m); });
      break;
    case MessageKind::info: heard = read<Info>(frame, [this](const Info& m) { on_info(m); }); break;
    case MessageKind::info_request: announce_ = true; break;
    case MessageKind::diagnostics:
    case MessageKind::fault: break;  // for diagnosis only
    default:
      if (!matched_) {
        count(health_.unmatched);
        return;
      }
      heard = on_frame(kind, frame);
  }
  settle(heard);
}

void Node::settle(FrameResult heard) noexcept {
  switch (heard) {
    case FrameResult::understood: count(health_.accepted); break;
    case FrameResult::out_of_range: count(health_.out_of_range); break;
    case FrameResult::unknown: count(health_.unknown); break;
  }
}

void Node::on_heartbeat(const Heartbeat& beat) noexcept {
  if (peer_known_ && beat.boot != peer_.boot) {
    count(peer_restarts_);
    stop(Error::peer_restarted);
    lose_peer();
    hash_known_ = false;
    peer_rules_ = 0;
    reset_peer();
  }
  if (!peer_heard_) announce_ = true;
  peer_known_ = true;
  peer_heard_ = true;
  peer_ = beat;
  peer_seen_ = now_;
  match();
  if (!hash_known_) send(InfoRequest{});
  if (beat.state == NodeState::safe_stop || beat.state == NodeState::e_stopped) stop(Error::peer_stopped);
}

void Node::on_info(const Info& info) noexcept {
  if (!peer_known_ || info.boot != peer_.boot) return;
  if (info.part == InfoPart::rules_hash) peer_rules_ = info.value;
  if (info.part != InfoPart::table_hash) return;
  hash_known_ = true;
  hash_right_ = info.value == kTableHash;
  match();
}

void Node::match() noexcept {
  const bool did = matched_;
  matched_ = peer_heard_ && peer_.protocol == kProtocol && hash_known_ && hash_right_;
  if (did && !matched_) stop(Error::wrong_version);
}

void Node::lose_peer() noexcept {
  peer_heard_ = false;
  matched_ = false;
  for (AliveReceiver& alive : heard_) alive.forget();
}

void Node::forget_operator() noexcept {
  for (AliveReceiver& alive : heard_operator_) alive.forget();
}

void Node::publish() noexcept {
  if (!guard_.on_bus()) return;
  Heartbeat beat;
  beat.state = state();
  beat.errors = errors();
  beat.boot = identity_.boot;
  beat.uptime_s = static_cast<uint8_t>((now_ - started_) / 1000);
  const bool changed = beat.state != said_.state || beat.errors != said_.errors;
  if ((announce_ || changed || now_ - said_at_ >= kHeartbeat_ms) && send(beat)) {
    said_ = beat;
    said_at_ = now_;
  }
  if (announce_) publish_info();
  publish_fault();
  publish_diagnostics();
}

void Node::publish_info() noexcept {
  announce_ = !(send(Info{InfoPart::table_hash, identity_.boot, kTableHash}) &&
                send(Info{InfoPart::version, identity_.boot, identity_.version}) &&
                (identity_.rules == 0 || send(Info{InfoPart::rules_hash, identity_.boot, identity_.rules})));
}

void Node::publish_fault() noexcept {
  const uint16_t bits = errors();
  const bool changed = bits != faults_said_;
  if (!changed && (bits == 0 || now_ - fault_said_at_ < kFaultRepeat_ms)) return;
  FaultReport report;
  report.errors = bits;
  report.core_fault = core_fault_;
  report.stops = at_most_16(health_.stops);
  report.severity = e_stopped_ || latched_ != 0 ? Severity::latched
                    : core_fault_ != 0          ? Severity::stopped
                    : bits != 0                 ? Severity::holding
                                                : Severity::none;
  if (!send(report)) return;
  faults_said_ = bits;
  fault_said_at_ = now_;
}

void Node::publish_diagnostics() noexcept {
  if (now_ - diagnosed_at_ < kDiagnostics_ms) return;
  diagnosed_at_ = now_;
  const hal::CanCounts& port = port_.counts();
  const BusHealth& h = health_;
  const uint32_t values[4][3] = {{h.crc, h.lost, h.repeated},
                                 {h.malformed, h.out_of_range, h.out_of_sequence},
                                 {guard_.bus_offs(), port.refused, port.expired},
                                 {port.overrun, h.skipped, h.stops}};
  Diagnostics what;
  what.part = diagnosis_;
  for (int i = 0; i < 3; ++i) what.value[i] = at_most_16(values[diagnosis_][i]);
  send(what);
  diagnosis_ = static_cast<uint8_t>((diagnosis_ + 1) % 4);
}

}  // namespace whisker::can
