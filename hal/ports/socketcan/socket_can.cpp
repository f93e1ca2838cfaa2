#include "hal/ports/socketcan/socket_can.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include "hal/ports/socketcan/interface.hpp"

namespace whisker::hal::socketcan {
namespace {

constexpr can_err_mask_t kErrors =
    CAN_ERR_LOSTARB | CAN_ERR_CRTL | CAN_ERR_PROT | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_BUSERROR;

bool gone(int error) noexcept { return error == ENETDOWN || error == ENODEV || error == ENXIO; }

template <class T>
bool set(int socket, int level, int option, const T& value) noexcept {
  return setsockopt(socket, level, option, &value, sizeof value) == 0;
}

std::vector<can_filter> filters_of(const std::vector<Accept>& accept) {
  std::vector<can_filter> filters;
  for (const Accept& a : accept) {
    const canid_t format = a.extended ? CAN_EFF_FLAG : 0U;
    const canid_t bits = a.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
    filters.push_back({(a.id & bits) | format, (a.mask & bits) | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  return filters;
}

CanFrame frame_of(const can_frame& wire) noexcept {
  CanFrame frame{};
  frame.extended = (wire.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (wire.can_id & CAN_RTR_FLAG) != 0;
  frame.id = wire.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.size = wire.len > CAN_MAX_DLEN ? uint8_t{CAN_MAX_DLEN} : wire.len;
  if (!frame.remote) std::memcpy(frame.data, wire.data, frame.size);
  return frame;
}

can_frame wire_of(const CanFrame& frame) noexcept {
  can_frame wire{};
  wire.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
  wire.len = frame.size;
  if (!frame.remote) std::memcpy(wire.data, frame.data, frame.size);
  return wire;
}

/// One frame for sendmmsg and recvmmsg. The result points to both arguments.
mmsghdr message_of(can_frame& wire, iovec& part) noexcept {
  part = {&wire, sizeof wire};
  mmsghdr message{};
  message.msg_hdr.msg_iov = &part;
  message.msg_hdr.msg_iovlen = 1;
  return message;
}

}  // namespace

SocketCan::SocketCan(std::string interface, std::vector<Accept> accept)
    : name_(std::move(interface)), accept_(std::move(accept)) {
  if (name_.empty() || name_.size() >= IFNAMSIZ)
    throw SocketCanError(name_ + ": not the name of a CAN interface");
  if (!open()) throw SocketCanError(name_ + ": no CAN in this kernel: " + std::strerror(errno));
}

SocketCan::~SocketCan() {
  if (socket_ >= 0) close(socket_);
}

bool SocketCan::open() noexcept {
  if (socket_ >= 0) close(socket_);
  bound_ = 0;
  lost_ = 0;
  socket_ = socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (socket_ < 0) return false;
  constexpr int kLeast = 1;  // the kernel raises it to its minimum of a few frames
  const std::vector<can_filter> filters = filters_of(accept_);
  const auto bytes = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
  return set(socket_, SOL_SOCKET, SO_SNDBUF, kLeast) && set(socket_, SOL_SOCKET, SO_RXQ_OVFL, 1) &&
         set(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrors) &&
         (filters.empty() || setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), bytes) == 0);
}

void SocketCan::join() noexcept {
  const Interface now = look_up(socket_, name_);
  wait_ = now.index == 0 ? Wait::interface : !now.up ? Wait::up : !now.running ? Wait::carrier : Wait::nothing;
  if (wait_ != Wait::nothing) return;
  if (bound_ != now.index) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = now.index;
    // A socket may stay bound to a deleted interface.
    if ((bound_ != 0 && !open()) ||
        bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      wait_ = Wait::interface;
      return;
    }
    bound_ = now.index;
  }
  state_ = CanState::active;
}

void SocketCan::leave() noexcept {
  outbox_.drop_all(counts_);
  state_ = CanState::starting;
  wait_ = Wait::up;
  look_now_ = true;
}

void SocketCan::restart() noexcept {
  leave();
  trouble_ = Trouble::none;
}

void SocketCan::see_error(const uint8_t* data, uint32_t kinds) noexcept {
  constexpr uint32_t kUnheard = CAN_ERR_ACK | CAN_ERR_PROT | CAN_ERR_BUSERROR;
  if ((kinds & (CAN_ERR_LOSTARB | kUnheard)) != 0) {
    trouble_ = (kinds & kUnheard) != 0 ? Trouble::unheard : Trouble::outbid;
    trouble_ms_ = now_ms_;
  }
  if ((kinds & CAN_ERR_CRTL) != 0) {
    constexpr int kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
    constexpr int kActive = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING | CAN_ERR_CRTL_ACTIVE;
    if ((data[1] & CAN_ERR_CRTL_RX_OVERFLOW) != 0) count(counts_.overrun);
    if ((data[1] & kPassive) != 0) {
      state_ = CanState::passive;
    } else if ((data[1] & kActive) != 0) {
      state_ = CanState::active;
    }
  }
  if ((kinds & CAN_ERR_BUSOFF) != 0) {
    count(counts_.bus_offs);
    outbox_.drop_all(counts_);
    state_ = CanState::bus_off;
  }
}

void SocketCan::take(const can_frame& wire) noexcept {
  if (!on_bus()) return;
  if ((wire.can_id & CAN_ERR_FLAG) != 0) {
    see_error(wire.data, wire.can_id);
  } else {
    inbox_.push(frame_of(wire), counts_);
  }
}

void SocketCan::see_loss(msghdr& message) noexcept {
  for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SO_RXQ_OVFL) continue;
    uint32_t lost = 0;
    std::memcpy(&lost, CMSG_DATA(c), sizeof lost);
    count(counts_.overrun, lost - lost_);
    lost_ = lost;
  }
}

void SocketCan::fetch() noexcept {
  constexpr unsigned kMost = kReceiveDepth;
  // While off the bus, all received frames are dropped.
  while (!on_bus() || !inbox_.full()) {
    can_frame wires[kMost];
    iovec parts[kMost];
    struct alignas(cmsghdr) Extra {
      char of[CMSG_SPACE(sizeof(uint32_t))];
    } extras[kMost];
    mmsghdr messages[kMost];
    const unsigned room = on_bus() ? inbox_.room() : kMost;
    for (unsigned i = 0; i < room; ++i) {
      messages[i] = message_of(wires[i], parts[i]);
      messages[i].msg_hdr.msg_control = &extras[i];
      messages[i].msg_hdr.msg_controllen = sizeof extras[i];
    }
    const int got = recvmmsg(socket_, messages, room, 0, nullptr);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      if (!gone(errno) || !on_bus()) return;
      leave();
      continue;
    }
    for (int i = 0; i < got; ++i) {
      see_loss(messages[i].msg_hdr);
      if (messages[i].msg_len == CAN_MTU) take(wires[i]);
    }
    if (static_cast<unsigned>(got) < room) return;
  }
}

void SocketCan::flush() noexcept {
  can_frame wires[kSendDepth];
  iovec parts[kSendDepth];
  mmsghdr messages[kSendDepth];
  unsigned waiting = 0;
  for (; const CanOutbox::Waiting* next = outbox_.at(static_cast<uint8_t>(waiting)); ++waiting) {
    wires[waiting] = wire_of(next->frame);
    messages[waiting] = message_of(wires[waiting], parts[waiting]);
  }
  for (unsigned done = 0; done < waiting;) {
    const int put = sendmmsg(socket_, messages + done, waiting - done, 0);
    const unsigned gone_out = put > 0 ? static_cast<unsigned>(put) : 0;
    if (put <= 0) {
      if (gone(errno)) return leave();
      if (errno == ENOBUFS || errno == EAGAIN || errno == EINTR) return;
      // Other errors do not pass with time: the controller is listen-only, or its driver rejects such frames.
      count(counts_.expired);
      outbox_.pop();
      ++done;
    }
    count(counts_.sent, gone_out);
    for (unsigned i = 0; i < gone_out; ++i) outbox_.pop();
    done += gone_out;
  }
}

bool SocketCan::send(const CanFrame& frame, uint8_t lifetime_ms) noexcept {
  return outbox_.put(frame, lifetime_ms, on_bus(), counts_);
}

bool SocketCan::receive(CanFrame& out) noexcept { return inbox_.pop(out, counts_); }

void SocketCan::expire() noexcept {
  const uint8_t expired = outbox_.expire(now_ms_, counts_);
  if (now_ms_ - trouble_ms_ > kBlameMs) trouble_ = Trouble::none;
  if (trouble_ == Trouble::outbid) count(counts_.outbid, expired);
  if (trouble_ == Trouble::unheard) count(counts_.unheard, expired);
}

void SocketCan::poll(uint32_t now_ms) noexcept {
  now_ms_ = now_ms;
  expire();
  if (socket_ < 0 && !open()) return;
  fetch();
  if (state_ == CanState::starting && (look_now_ || now_ms - looked_ms_ >= kLookMs)) {
    look_now_ = false;
    looked_ms_ = now_ms;
    join();
    if (on_bus()) fetch();
  }
  if (on_bus()) flush();
}

std::string SocketCan::waits_for() const {
  if (on_bus()) return {};
  if (state_ == CanState::bus_off) return name_ + " is bus-off";
  switch (wait_) {
    case Wait::interface: return name_ + " does not exist";
    case Wait::up: return name_ + " is down";
    case Wait::carrier: return name_ + " has no carrier: bus-off, or its other end is missing";
    case Wait::nothing: return {};
  }
  return {};
}

}  // namespace whisker::hal::socketcan
