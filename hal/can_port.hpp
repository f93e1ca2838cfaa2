#pragma once

#include <stdint.h>

namespace whisker::hal {

/// One classic CAN frame.
struct CanFrame {
  uint32_t id;    ///< 11 bits, or 29 bits if extended
  bool extended;  ///< 29-bit identifier
  bool remote;    ///< remote transmission request: `data` is not used
  uint8_t size;   ///< bytes of data, 0..8
  uint8_t data[8];
};

enum class CanState : uint8_t {
  off,       ///< never started, or the CAN controller did not answer
  starting,  ///< waits for an idle bus, or for its interface or line
  active,    ///< on the bus
  passive,   ///< on the bus; an error counter exceeded 127
  bus_off,   ///< the transmit error counter exceeded 255; silent until restart()
};

/// Why frames were lost. Counters saturate.
struct CanCounts {
  uint32_t sent = 0;
  uint32_t received = 0;
  uint32_t refused = 0;      ///< send() found the queue full, the port off the bus, or the frame malformed
  uint32_t expired = 0;      ///< removed from the queue unsent: too old, or bus-off
  uint32_t outbid = 0;       ///< of the expired: the last try lost arbitration
  uint32_t unheard = 0;      ///< of the expired: the last try met an error or no acknowledgement
  uint32_t overrun = 0;      ///< number of times that received frames were lost because the queue was full
  uint32_t bus_offs = 0;     ///< entries into bus_off
  uint32_t not_started = 0;  ///< number of times that the CAN controller did not answer in time
};

/// A CAN controller as the protocol uses it: frames in, frames out, and counters.
///
/// No call waits for the bus: send() and receive() access queues only, and poll() does the rest. send()
/// copies the frame. Frames leave in the order of send(), or are dropped and counted: a frame that is not
/// sent within `lifetime_ms` is stale, and a stale command is worse than none.
class CanPort {
 public:
  static constexpr uint8_t kSendDepth = 16;     ///< frames that send() accepts before poll() must run
  static constexpr uint8_t kReceiveDepth = 16;  ///< frames kept until receive() takes them
  static constexpr uint8_t kLongestLife = 100;  ///< ms

  /// lifetime_ms: 1..kLongestLife. False: the frame was counted as refused and dropped.
  virtual bool send(const CanFrame& frame, uint8_t lifetime_ms) noexcept = 0;
  /// The oldest received frame. False: there is none; `out` is unchanged.
  virtual bool receive(CanFrame& out) noexcept = 0;
  /// Call every one or two milliseconds: moves frames, drops stale ones, updates the state.
  virtual void poll(uint32_t now_ms) noexcept = 0;
  /// Returns to the bus after bus_off or off. It takes 128 idle times of the bus; until then the state is
  /// `starting`. The protocol decides when and how often; a port never restarts by itself.
  virtual void restart() noexcept = 0;

  virtual CanState state() const noexcept = 0;
  virtual const CanCounts& counts() const noexcept = 0;

 protected:
  ~CanPort() = default;
};

}  // namespace whisker::hal
