#include "host/hil/line.hpp"

#include "hal/socketcan/socket_can.hpp"

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

}  // namespace

std::unique_ptr<Line> open_line(const std::string& name) {
  try {
    return std::make_unique<SocketCanLine>(name);
  } catch (const hal::socketcan::SocketCanError& e) {
    throw BusError(e.what());
  }
}

}  // namespace whisker::hil
