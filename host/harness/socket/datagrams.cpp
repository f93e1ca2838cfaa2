// A channel over UDP.
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <utility>

#include "host/harness/socket/channel.hpp"
#include "host/harness/socket/descriptor.hpp"

namespace whisker::socket {
namespace {

class Datagrams final : public Channel {
 public:
  explicit Datagrams(Descriptor socket) : socket_(std::move(socket)) {}

  /// Hears the first sender only. An empty datagram after its first tick is the end: UDP has no connection to
  /// close.
  std::optional<std::string> read(double most_s) override {
    const Deadline deadline(most_s);
    for (;;) {
      if (!wait_for(socket_, POLLIN, deadline.left_s()))
        throw ChannelError(fmt::format("no line for {} s", most_s));
      std::string line(kLongestLine, '\0');
      sockaddr_in from{};
      socklen_t size = sizeof from;
      const ssize_t got = ::recvfrom(socket_.number(), line.data(), line.size(), 0,
                                     reinterpret_cast<sockaddr*>(&from), &size);
      if (got < 0) throw ChannelError(fmt::format("recvfrom: {}", std::strerror(errno)));
      line.resize(static_cast<std::size_t>(got));
      while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
      const bool other =
          lines_ > 0 && (from.sin_addr.s_addr != peer_.sin_addr.s_addr || from.sin_port != peer_.sin_port);
      if (other || (line.empty() && lines_ < 2)) continue;
      if (line.empty()) return std::nullopt;
      peer_ = from;
      ++lines_;
      return line;
    }
  }

  void write(std::string_view line, double most_s) override {
    if (!wait_for(socket_, POLLOUT, most_s)) throw ChannelError("the socket takes no datagram");
    std::string all(line);
    all += '\n';
    const ssize_t n = ::sendto(socket_.number(), all.data(), all.size(), 0,
                               reinterpret_cast<const sockaddr*>(&peer_), sizeof peer_);
    // An unreachable sender is one that lost the answer: it asks again.
    if (n < 0 && errno != ECONNREFUSED) throw ChannelError(fmt::format("sendto: {}", std::strerror(errno)));
  }

 private:
  Descriptor socket_;
  sockaddr_in peer_{};
  std::uint64_t lines_ = 0;
};

}  // namespace

std::unique_ptr<Channel> bind_udp(const std::string& address, int port,
                                  const std::function<void(int)>& listening) {
  Descriptor socket = bound(SOCK_DGRAM, address, port);
  listening(port_of(socket));
  return std::make_unique<Datagrams>(std::move(socket));
}

}  // namespace whisker::socket
