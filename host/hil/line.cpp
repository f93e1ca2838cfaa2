#include "host/hil/line.hpp"

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
  explicit SlcanLine(const std::string& path) : tty_(path), port_(tty_, hal::slcan::Role::host) {}
  hal::CanPort& port() override { return port_; }
  int descriptor() const override { return tty_.descriptor(); }
  std::string waits_for() const override { return tty_.waits_for(); }

 private:
  hal::tty::TtyLine tty_;
  hal::slcan::Slcan port_;
};

constexpr const char* kSlcan = "slcan:";

}  // namespace

std::unique_ptr<Line> open_line(const std::string& name) {
  try {
    if (name.rfind(kSlcan, 0) == 0) {
      return std::make_unique<SlcanLine>(name.substr(std::char_traits<char>::length(kSlcan)));
    }
    return std::make_unique<SocketCanLine>(name);
  } catch (const hal::socketcan::SocketCanError& e) {
    throw BusError(e.what());
  } catch (const hal::tty::TtyError& e) {
    throw BusError(e.what());
  }
}

}  // namespace whisker::hil
