#include "host/harness/hil/line.hpp"

#include <cerrno>
#include <cstring>

#include <sys/socket.h>
#include <unistd.h>

#include "hal/ports/slcan/slcan.hpp"
#include "hal/ports/socketcan/socket_can.hpp"
#include "hal/ports/tty/tty_line.hpp"

namespace whisker::hil {
namespace {

class SocketCanLine final : public Line {
 public:
  explicit SocketCanLine(const std::string& name) : port_(name) {}
  hal::CanPort& port() override { return port_; }
  int descriptor() const override { return port_.descriptor(); }
  std::string waits_for() const override { return port_.waits_for(); }

 private:
  hal::socketcan::SocketCan port_;
};

class SlcanLine final : public Line {
 public:
  SlcanLine(const std::string& path, int baud) : tty_(path, baud), port_(tty_, hal::slcan::Role::host) {}
  hal::CanPort& port() override { return port_; }
  int descriptor() const override { return tty_.descriptor(); }
  std::string waits_for() const override {
    const std::string what = tty_.waits_for();
    if (!what.empty()) return what;
    if (port_.state() == hal::CanState::off) return "the adapter, which refuses 500 kbit/s or to open";
    const bool none = port_.line_counts().bad_lines > 0 && port_.counts().received == 0;
    return none ? "frames: the adapter sends lines that are none" : "";
  }

 private:
  hal::tty::TtyLine tty_;
  hal::slcan::Slcan port_;
};

constexpr const char* kSlcan = "slcan:";

/// Frames as packets of a socket pair: frames are lost only if the other end receives them too late.
class PacketLine final : public Line, private hal::CanPort {
 public:
  explicit PacketLine(int socket) : socket_(socket) {}
  ~PacketLine() override { close(socket_); }
  PacketLine(const PacketLine&) = delete;
  PacketLine& operator=(const PacketLine&) = delete;

  hal::CanPort& port() override { return *this; }
  int descriptor() const override { return socket_; }
  std::string waits_for() const override { return open_ ? "" : "the other end of the private bus"; }

 private:
  bool send(const hal::CanFrame& frame, std::uint8_t) noexcept override {
    const ssize_t n = ::send(socket_, &frame, sizeof frame, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n < 0 && errno != EAGAIN) open_ = false;
    ++(n > 0 ? counts_.sent : counts_.refused);
    return n > 0;
  }
  bool receive(hal::CanFrame& out) noexcept override {
    hal::CanFrame frame{};
    const ssize_t n = ::recv(socket_, &frame, sizeof frame, MSG_DONTWAIT);
    if (n == 0) open_ = false;
    if (n != sizeof frame) return false;
    ++counts_.received;
    out = frame;
    return true;
  }
  void poll(std::uint32_t) noexcept override {}
  void restart() noexcept override {}
  hal::CanState state() const noexcept override { return open_ ? hal::CanState::active : hal::CanState::off; }
  const hal::CanCounts& counts() const noexcept override { return counts_; }

  int socket_;
  bool open_ = true;
  hal::CanCounts counts_;
};

}  // namespace

std::unique_ptr<Line> open_line(const std::string& name) {
  try {
    if (name.rfind(kSlcan, 0) == 0) {
      const std::string device = name.substr(std::char_traits<char>::length(kSlcan));
      const std::size_t at = device.rfind('@');
      const std::string speed = at == std::string::npos ? "" : device.substr(at + 1);
      const bool is_speed =
          !speed.empty() && speed.size() < 8 && speed.find_first_not_of("0123456789") == std::string::npos;
      if (!is_speed) return std::make_unique<SlcanLine>(device, hal::tty::TtyLine::kBaud);
      return std::make_unique<SlcanLine>(device.substr(0, at), std::stoi(speed));
    }
    return std::make_unique<SocketCanLine>(name);
  } catch (const hal::socketcan::SocketCanError& e) {
    throw BusError(e.what());
  } catch (const hal::tty::TtyError& e) {
    throw BusError(e.what());
  }
}

std::pair<std::unique_ptr<Line>, std::unique_ptr<Line>> private_lines() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    throw BusError(std::string("no private bus: ") + std::strerror(errno));
  }
  return {std::make_unique<PacketLine>(ends[0]), std::make_unique<PacketLine>(ends[1])};
}

}  // namespace whisker::hil
