#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "hal/ports/can_queue.hpp"

// Declared by Linux.
struct can_frame;
struct msghdr;

namespace whisker::hal::socketcan {

struct SocketCanError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Filter of received frames: the identifier must match `id` in the bits where `mask` is 1. Data frames of
/// this format only.
struct Accept {
  uint32_t id;
  uint32_t mask;
  bool extended;
};

/// A CAN interface of Linux through a raw socket. No call blocks.
///
/// The interface may be missing, down, or without a carrier. The state is then `starting`, and poll() joins
/// as soon as it can, also after the interface was deleted and created again. Frames in the queues at that
/// time are dropped. After bus-off, the kernel restarts the controller if it was set up with `restart-ms`, or
/// an administrator does with `ip link set`; from restart() until then the state is `starting`. The error
/// state is known from its first change on. sent: the kernel accepted the frame. A frame in the kernel cannot
/// be withdrawn, so only few are handed over at a time. overrun includes frames that the controller or the
/// kernel lost. outbid, unheard: according to the last error frame.
class SocketCan final : public CanPort {
 public:
  static constexpr uint32_t kBlameMs = 100;
  static constexpr uint32_t kLookMs = 20;  ///< period of checks for a missing interface

  /// accept: empty accepts all frames. Throws SocketCanError if the kernel has no CAN or the name is invalid.
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

  /// For people: what keeps the port off the bus; empty while it is on the bus.
  std::string waits_for() const;
  /// Becomes readable when poll() has something to receive. Changes in poll() only.
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
  int bound_ = 0;  // index of the interface
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
