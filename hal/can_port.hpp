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
  off,       ///< never started, or the controller did not answer
  starting,  ///< waits for the bus to be idle, or for its interface or line to be there
  active,    ///< takes part in the bus
  passive,   ///< still takes part; an error counter passed 127
  bus_off,   ///< its transmit errors passed 255; silent until restart()
};

/// Why frames did not arrive. Each counter stops at its maximum.
struct CanCounts {
  uint32_t sent = 0;
  uint32_t received = 0;
  uint32_t refused = 0;      ///< send() found the queue full, the port not on the bus, or the frame malformed
  uint32_t expired = 0;      ///< left the queue unsent: too old, or the port went bus-off
  uint32_t outbid = 0;       ///< of the expired: its last try lost to a frame of higher priority
  uint32_t unheard = 0;      ///< of the expired: its last try met an error or no acknowledgement
  uint32_t overrun = 0;      ///< times that received frames were lost: nobody took those before
  uint32_t bus_offs = 0;     ///< entries into bus_off
  uint32_t not_started = 0;  ///< times the controller did not answer in its time
};

/// A CAN controller as the protocol sees it: frames in, frames out, and what became of them.
///
/// Nothing here waits for the bus: send() and receive() touch queues only, and poll() does the rest.
/// A frame handed to send() is copied; it leaves in the order of send(), or is dropped and counted:
/// what could not be sent within `lifetime_ms` is stale, and a stale command is worse than none.
class CanPort {
 public:
  static constexpr uint8_t kSendDepth = 16;     ///< frames that send() takes before poll() must run
  static constexpr uint8_t kReceiveDepth = 16;  ///< frames kept until receive() takes them
  static constexpr uint8_t kLongestLife = 100;  ///< ms

  /// lifetime_ms: 1..kLongestLife. False: counted as refused; nothing was kept.
  virtual bool send(const CanFrame& frame, uint8_t lifetime_ms) noexcept = 0;
  /// The oldest frame received. False: there is none; `out` is untouched.
  virtual bool receive(CanFrame& out) noexcept = 0;
  /// Call it at least every millisecond or two: moves frames, drops stale ones, sees state changes.
  virtual void poll(uint32_t now_ms) noexcept = 0;
  /// Back onto the bus after bus_off or off. It takes 128 idle times of the bus; the state is `starting`
  /// until then. When and how often is the protocol's to decide: a port never restarts by itself.
  virtual void restart() noexcept = 0;

  virtual CanState state() const noexcept = 0;
  virtual const CanCounts& counts() const noexcept = 0;

 protected:
  ~CanPort() = default;
};

}  // namespace whisker::hal
