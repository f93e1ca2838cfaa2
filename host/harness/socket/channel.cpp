#include "host/harness/socket/channel.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "host/harness/socket/descriptor.hpp"

namespace whisker::socket {

Descriptor::~Descriptor() {
  if (number_ > STDERR_FILENO) ::close(number_);
}

using Clock = std::chrono::steady_clock;

Deadline::Deadline(double most_s)
    : until_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(most_s))) {}

double Deadline::left_s() const { return std::chrono::duration<double>(until_ - Clock::now()).count(); }

bool wait_for(const Descriptor& descriptor, short events, double most_s) {
  const Deadline deadline(most_s);
  for (;;) {
    const double left_s = deadline.left_s();
    if (left_s < 0) return false;
    pollfd fd{descriptor.number(), events, 0};
    const int ready = ::poll(&fd, 1, static_cast<int>(std::ceil(left_s * 1000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) throw ChannelError(fmt::format("poll: {}", std::strerror(errno)));
  }
}

Descriptor bound(int type, const std::string& address, int port) {
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, address.c_str(), &at.sin_addr) != 1)
    throw ChannelError(fmt::format("'{}' is no IPv4 address", address));
  Descriptor socket(::socket(AF_INET, type | SOCK_CLOEXEC, 0));
  const int yes = 1;
  if (socket.number() >= 0 && type == SOCK_STREAM)
    ::setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (socket.number() < 0 || ::bind(socket.number(), reinterpret_cast<sockaddr*>(&at), sizeof at) != 0)
    throw ChannelError(fmt::format("{}:{}: {}", address, port, std::strerror(errno)));
  return socket;
}

int port_of(const Descriptor& socket) {
  sockaddr_in at{};
  socklen_t size = sizeof at;
  ::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&at), &size);
  return ntohs(at.sin_port);
}

}  // namespace whisker::socket
