/// The common part of both nodes: frame checks and counters, handshake, heartbeat, latches.
///
///            port on the bus        handshake matches        order
///   off_bus -----------------> waiting ------------> ready --------> running
///      ^                          ^                    ^               |
///      | port off the bus         | peer lost          | new order     | time-out, peer stopped, bus-off
///      +-- any                    +-- any              +-- safe_stop <-+
///
///   any -- a frame on an E-stop identifier --> e_stopped -- a valid clear, wheels at rest --> other states
#pragma once

#include <stdint.h>

#include "firmware/can/bus_guard.hpp"
#include "firmware/can/codec.hpp"
#include "firmware/can/headers.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/health.hpp"

namespace whisker::can {

/// Received-frame counters by result: each frame counts once in the first eleven. Counters saturate.
struct BusHealth {
  uint32_t accepted = 0;         ///< executed or understood
  uint32_t foreign = 0;          ///< other robots or protocols: no error
  uint32_t malformed = 0;        ///< remote, extended or of wrong length, or not allowed for its sender
  uint32_t crc = 0;              ///< wrong CRC
  uint32_t repeated = 0;         ///< the same counter as the last frame
  uint32_t out_of_sequence = 0;  ///< the counter jumped
  uint32_t out_of_range = 0;     ///< a value outside its range
  uint32_t unmatched = 0;        ///< before the handshake
  uint32_t duplicates = 0;       ///< sent by another node with this node's number
  uint32_t e_stops = 0;          ///< on an E-stop identifier
  uint32_t unknown = 0;          ///< of the other node, but a message that this one does not handle

  uint32_t stale = 0;    ///< of the accepted: answers to old sets, sets of another mission
  uint32_t lost = 0;     ///< missing according to the counters
  uint32_t skipped = 0;  ///< ticks without a complete input set
  uint32_t stops = 0;    ///< safe stops
};

struct Identity {
  uint8_t robot = 0;     ///< 1..kRobots
  uint16_t boot = 0;     ///< a new number at every start
  uint32_t version = 0;  ///< of the firmware: major << 16 | minor << 8 | patch
  uint32_t rules = 0;    ///< fuzzy::digest() of the response table; 0: has none
};

/// Result of a node for a valid frame in sequence.
enum class FrameResult : uint8_t {
  understood,
  out_of_range,  ///< a value is out of range
  unknown,       ///< the node does not handle this message
};

class Node {
 public:
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  NodeState state() const noexcept;
  uint16_t errors() const noexcept;
  /// Errors of this or the other node that no order ends: that node must restart.
  uint16_t permanent_errors() const noexcept;
  const BusHealth& health() const noexcept { return health_; }
  /// The other node is alive, with the same protocol and table.
  bool matched() const noexcept { return matched_; }
  const Heartbeat& peer() const noexcept { return peer_; }  ///< its last heartbeat
  bool peer_heard() const noexcept { return peer_heard_; }
  uint32_t peer_restarts() const noexcept { return peer_restarts_; }
  /// Hash of the own response table; 0: has none.
  uint32_t rules() const noexcept { return identity_.rules; }
  /// The same of the other node; 0: unknown.
  uint32_t peer_rules() const noexcept { return peer_rules_; }
  /// Asks the other node for its Info, also for what a lost frame contained. Until it comes, peer_rules() is
  /// 0.
  void ask_for_info() noexcept {
    peer_rules_ = 0;
    send(InfoRequest{});
  }
  bool lockstep() const noexcept { return sync_mode_ == SyncMode::lockstep; }
  uint32_t now_ms() const noexcept { return now_; }

  /// Error bits that only the owner knows: core_fault, drive_refused, sensors_refused.
  void report(uint16_t bits, uint8_t core_fault) noexcept;
  /// Sends an E-stop to this robot and executes it.
  void press_e_stop() noexcept;

 protected:
  Node(hal::CanPort& port, Party party, const Identity& identity) noexcept;
  ~Node() = default;

  // Not pure, because that requires a run-time library.
  /// Handles a valid frame of the other node, or of the operator to a controller, in sequence, after the
  /// handshake.
  virtual FrameResult on_frame(MessageKind, const hal::CanFrame&) noexcept { return FrameResult::unknown; }
  static constexpr FrameResult in_range(bool is) noexcept {
    return is ? FrameResult::understood : FrameResult::out_of_range;
  }
  /// Decodes the message of the frame and passes it to `use`, unless a value is out of range.
  template <class M, class Use>
  static FrameResult read(const hal::CanFrame& frame, const Use& use) noexcept {
    M message;
    if (!decode(frame, message)) return FrameResult::out_of_range;
    use(message);
    return FrameResult::understood;
  }
  /// The next frame of each message of the operator is in sequence, whatever its counter.
  void forget_operator() noexcept;
  /// Sends Info with the next publish().
  void announce() noexcept { announce_ = true; }
  /// The other node has restarted: its earlier messages are void.
  virtual void reset_peer() noexcept {}
  virtual bool at_rest() const noexcept { return true; }
  /// Time-outs are active.
  virtual bool timed() const noexcept { return !lockstep(); }

  /// Processes received frames and time-outs of the other node. The derived node then checks its own
  /// time-outs and publishes.
  void listen(uint32_t now_ms) noexcept;
  /// Sends Heartbeat, Info, Fault and Diagnostics when they are due.
  void publish() noexcept;
  template <class M>
  bool send(const M& m, uint8_t life_ms = kEventLife_ms) noexcept {
    AliveSender& alive = sent_[static_cast<uint8_t>(M::kKind)];
    const AliveSender before = alive;
    if (port_.send(encode(m, node_, alive.next()), life_ms)) return true;
    alive = before;
    return false;
  }
  /// Lets the port send queued frames.
  void flush() noexcept { port_.poll(now_); }
  /// Latches a safe stop if the robot is running. Time-outs do so only while timed().
  void stop(uint16_t error) noexcept;
  /// A new order ends a safe stop. False: an E-stop is active, or the handshake is missing.
  bool run() noexcept;
  void rest() noexcept { running_ = false; }
  /// Ends a safe stop without driving. Some causes are permanent.
  void release() noexcept;
  bool running() const noexcept { return state() == NodeState::running; }
  bool ordered() const noexcept { return running_; }  ///< as running(), even if the bus is down
  /// Announces another response table than that of the Identity.
  void set_rules(uint32_t hash) noexcept;
  void set_sync_mode(SyncMode sync_mode) noexcept { sync_mode_ = sync_mode; }
  BusHealth& tally() noexcept { return health_; }

 private:
  void receive(const hal::CanFrame& frame) noexcept;
  void receive_e_stop(const hal::CanFrame& frame) noexcept;
  void receive_from_operator(MessageKind kind, const hal::CanFrame& frame) noexcept;
  bool is_for_us(uint8_t node) const noexcept;
  bool is_sound(MessageKind kind, const hal::CanFrame& frame) noexcept;
  bool is_whole(MessageKind kind, const hal::CanFrame& frame, bool allowed) noexcept;
  void understand(MessageKind kind, const hal::CanFrame& frame, AliveReceiver& alive) noexcept;
  void settle(FrameResult heard) noexcept;
  void on_heartbeat(const Heartbeat& beat) noexcept;
  void on_info(const Info& info) noexcept;
  void match() noexcept;
  void lose_peer() noexcept;
  void publish_info() noexcept;
  void publish_fault() noexcept;
  void publish_diagnostics() noexcept;

  hal::CanPort& port_;
  Identity identity_;
  const Party party_;
  const uint8_t node_;
  const uint8_t peer_node_;
  BusGuard guard_;
  BusHealth health_;
  AliveSender sent_[kKinds];
  AliveReceiver heard_[kKinds];
  AliveReceiver heard_operator_[kOperatorKinds];

  Heartbeat peer_;
  uint32_t peer_seen_ = 0;
  uint32_t peer_restarts_ = 0;
  uint32_t peer_rules_ = 0;
  bool peer_known_ = false;
  bool peer_heard_ = false;
  bool hash_known_ = false;
  bool hash_right_ = false;
  bool matched_ = false;

  SyncMode sync_mode_ = SyncMode::real_time;
  bool running_ = false;
  bool e_stopped_ = false;
  uint16_t latched_ = 0;
  uint16_t standing_ = 0;
  uint8_t core_fault_ = 0;

  uint32_t now_ = 0;
  uint32_t started_ = 0;
  bool begun_ = false;
  bool announce_ = true;
  Heartbeat said_;
  uint32_t said_at_ = 0;
  uint16_t faults_said_ = 0;
  uint32_t fault_said_at_ = 0;
  uint32_t diagnosed_at_ = 0;
  uint8_t diagnosis_ = 0;
};

}  // namespace whisker::can
