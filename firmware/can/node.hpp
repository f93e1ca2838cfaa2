/// What both parties do alike: frames checked and counted, the handshake, the heartbeat, the latches.
///
///            port on the bus        handshake matches        order
///   off_bus -----------------> waiting ------------> ready --------> running
///      ^                          ^                    ^               |
///      | port off the bus         | peer lost          | new order     | time-out, peer stopped, bus-off
///      +-- any                    +-- any              +-- safe_stop <-+
///
///   any -- a frame on an E-stop identifier --> e_stopped -- a valid clear, wheels at rest --> what else
///   holds
#pragma once

#include <stdint.h>

#include "firmware/can/bus_guard.hpp"
#include "firmware/can/codec.hpp"
#include "firmware/can/heads.hpp"
#include "firmware/can/limits.hpp"
#include "firmware/health.hpp"

namespace whisker::can {

/// Frames that came, by what became of them: each counts once in the first eleven. Each counter stops at its
/// maximum.
struct BusHealth {
  uint32_t accepted = 0;      ///< obeyed, or at least understood
  uint32_t foreign = 0;       ///< other robots, other protocols: no error
  uint32_t malformed = 0;     ///< remote, extended or of a wrong length; or the sender may not say that
  uint32_t crc = 0;           ///< wrong CRC
  uint32_t repeated = 0;      ///< the counter of the frame before
  uint32_t astray = 0;        ///< the counter jumped
  uint32_t out_of_range = 0;  ///< a value outside its range
  uint32_t unmatched = 0;     ///< before the handshake
  uint32_t duplicates = 0;    ///< sent by somebody else with this node's number
  uint32_t e_stops = 0;       ///< on an E-stop identifier
  uint32_t unknown = 0;       ///< of the other party, and this one has no use for such a message

  uint32_t stale = 0;    ///< of the accepted: answers to a set of long ago, sets of another mission
  uint32_t lost = 0;     ///< never came, by the counters of those that did
  uint32_t skipped = 0;  ///< ticks without a complete input set
  uint32_t stops = 0;    ///< safe stops
};

struct Identity {
  uint8_t robot;     ///< 1..kRobots
  uint16_t boot;     ///< another one at every start
  uint32_t version;  ///< of the firmware: major << 16 | minor << 8 | local grid
};

/// What a party makes of a frame that is whole and in turn.
enum class Heard : uint8_t {
  understood,
  out_of_range,  ///< a value is
  unknown,       ///< the party has no use for such a message
};

class Node {
 public:
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  NodeState state() const noexcept;
  uint16_t errors() const noexcept;
  /// The errors among its own and the other party's that no order ends: that party must start anew.
  uint16_t for_good() const noexcept;
  const BusHealth& health() const noexcept { return health_; }
  /// The other party lives, and speaks this protocol with this table.
  bool matched() const noexcept { return matched_; }
  const Heartbeat& peer() const noexcept { return peer_; }  ///< its last heartbeat
  bool peer_heard() const noexcept { return peer_heard_; }
  uint32_t peer_restarts() const noexcept { return peer_restarts_; }
  bool lockstep() const noexcept { return pace_ == Pace::lockstep; }
  uint32_t now_ms() const noexcept { return now_; }

  /// Error bits that only the owner knows: core_fault, drive_refused, sensors_refused.
  void report(uint16_t bits, uint8_t core_fault) noexcept;
  /// Sends an E-stop to this robot, and obeys it.
  void press_e_stop() noexcept;

 protected:
  Node(hal::CanPort& port, Party party, const Identity& identity) noexcept;
  ~Node() = default;

  // Not pure: that would ask for a run-time library.
  /// A frame of the other party that is whole and in turn, after the handshake.
  virtual Heard hear(Kind, const hal::CanFrame&) noexcept { return Heard::unknown; }
  static constexpr Heard in_range(bool is) noexcept { return is ? Heard::understood : Heard::out_of_range; }
  /// Gives the frame's message to `use`, unless a value is out of its range.
  template <class M, class Use>
  static Heard read(const hal::CanFrame& frame, const Use& use) noexcept {
    M message;
    if (!decode(frame, message)) return Heard::out_of_range;
    use(message);
    return Heard::understood;
  }
  /// The other party has started anew: nothing that it said before counts.
  virtual void forget_peer() noexcept {}
  virtual bool at_rest() const noexcept { return true; }
  /// Lateness counts now.
  virtual bool timed() const noexcept { return !lockstep(); }

  /// Hears what came, and sees what did not. The party looks after its own time-outs next, then publishes.
  void listen(uint32_t now_ms) noexcept;
  /// Heartbeat, Info, Fault and Diagnostics, as they are due.
  void publish() noexcept;
  template <class M>
  bool send(const M& m, uint8_t life_ms = kEventLife_ms) noexcept {
    AliveSender& alive = sent_[static_cast<uint8_t>(M::kKind)];
    const AliveSender before = alive;
    if (port_.send(encode(m, node_, alive.next()), life_ms)) return true;
    alive = before;
    return false;
  }
  /// Lets the port move what was sent just now.
  void flush() noexcept { port_.poll(now_); }
  /// Latches a safe stop if the robot is running. Lateness does so only while timed().
  void stop(uint16_t error) noexcept;
  /// A new order ends a safe stop. False: an E-stop stands, or there is no handshake.
  bool run() noexcept;
  void rest() noexcept { running_ = false; }
  /// Ends a safe stop without driving. Some causes stay for good.
  void release() noexcept;
  bool running() const noexcept { return state() == NodeState::running; }
  bool ordered() const noexcept { return running_; }  ///< as running(), though the bus may be down
  void set_pace(Pace pace) noexcept { pace_ = pace; }
  BusHealth& tally() noexcept { return health_; }

 private:
  void receive(const hal::CanFrame& frame) noexcept;
  void receive_e_stop(const hal::CanFrame& frame) noexcept;
  bool is_for_us(uint8_t node) const noexcept;
  bool is_sound(Kind kind, const hal::CanFrame& frame) noexcept;
  void understand(Kind kind, const hal::CanFrame& frame) noexcept;
  void settle(Heard heard) noexcept;
  void hear_heartbeat(const Heartbeat& beat) noexcept;
  void hear_info(const Info& info) noexcept;
  void match() noexcept;
  void lose_peer() noexcept;
  void publish_info() noexcept;
  void publish_fault() noexcept;
  void publish_diagnostics() noexcept;

  hal::CanPort& port_;
  const Identity identity_;
  const Party party_;
  const uint8_t node_;
  const uint8_t peer_node_;
  BusGuard guard_;
  BusHealth health_;
  AliveSender sent_[kKinds];
  AliveReceiver heard_[kKinds];

  Heartbeat peer_;
  uint32_t peer_seen_ = 0;
  uint32_t peer_restarts_ = 0;
  bool peer_known_ = false;
  bool peer_heard_ = false;
  bool hash_known_ = false;
  bool hash_right_ = false;
  bool matched_ = false;

  Pace pace_ = Pace::real_time;
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
