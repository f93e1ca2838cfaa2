#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "hal/ports/can_queue.hpp"

// Linux's.
struct can_frame;
struct msghdr;

namespace whisker::hal::socketcan {

struct SocketCanError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Frames that are received: those whose identifier has the bits of `id` where `mask` is 1. Data frames only,
/// of this format only.
struct Accept {
  uint32_t id;
  uint32_t mask;
  bool extended;
};

/// A CAN interface of Linux, by a raw socket. Nothing waits.
///
/// The interface need not be there: while it is missing, down, or without a carrier, the state is `starting`,
/// and poll() joins by itself as soon as it can, also after the interface was deleted and made anew. What
/// waited to be sent or received when it went is dropped. After bus-off the kernel restarts a controller, if
/// it was set up with `restart-ms`, or who may `ip link set`; the port is `starting` from restart() until
/// then. The error state is known from the first change on. sent: the kernel took it; a frame that waits in
/// the kernel cannot be taken back, so those are kept few. overrun: also frames that the controller or the
/// kernel lost. outbid, unheard: by the last error frame before.
class SocketCan final : public CanPort {
 public:
  static constexpr uint32_t kBlameMs = 100;
  static constexpr uint32_t kLookMs = 20;  ///< between two looks at an interface that is waited for

  /// accept: empty means everything. Throws SocketCanError if the kernel has no CAN or the name is none.
  explicit SocketCan(std::string interface, std::vector<Accept> accept = {});
  ~SocketCan();
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;

  bool send(const CanFrame& frame, uint8_t lifetime_ms) noexcept override;
  bool receive(CanFrame& out) noexcept override;
  void poll(uint32_t now_ms) noexcept override;
  void restart() noexcept override;
  CanState state() const noexcept override { return state_; }
  const CanCounts& counts() const noexcept override { return counts_; }

  /// For a person: what keeps the port from the bus; empty while it takes part.
  std::string waits_for() const;
  /// Becomes readable when poll() has something to receive. Changes only in poll().
  int descriptor() const noexcept { return socket_; }

 private:
  enum class Trouble : uint8_t { none, outbid, unheard };
  enum class Wait : uint8_t { nothing, interface, up, carrier };
  bool on_bus() const noexcept { return state_ == CanState::active || state_ == CanState::passive; }
  bool open() noexcept;
  void join() noexcept;
  void leave() noexcept;
  void fetch() noexcept;
  void flush() noexcept;
  void see_error(const uint8_t* data, uint32_t kinds) noexcept;
  void expire() noexcept;
  void take(const can_frame& wire) noexcept;
  void see_loss(msghdr& message) noexcept;

  std::string name_;
  std::vector<Accept> accept_;
  int socket_ = -1;
  int bound_ = 0;  // the interface's index
  CanState state_ = CanState::starting;
  Wait wait_ = Wait::interface;
  Trouble trouble_ = Trouble::none;
  uint32_t trouble_ms_ = 0;
  uint32_t now_ms_ = 0;
  uint32_t lost_ = 0;  // of this socket, by the kernel's count
  uint32_t looked_ms_ = 0;
  bool look_now_ = true;
  CanOutbox outbox_;
  CanInbox inbox_;
  CanCounts counts_;
};

}  // namespace whisker::hal::socketcan
