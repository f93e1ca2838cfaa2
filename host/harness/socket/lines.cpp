// Channels over byte streams.
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "host/harness/socket/channel.hpp"
#include "host/harness/socket/descriptor.hpp"

namespace whisker::socket {
namespace {

constexpr double kSilence_s = 1;

class Stream final : public Channel {
 public:
  Stream(Descriptor in, Descriptor out) : in_(std::move(in)), out_(std::move(out)) {}
  explicit Stream(Descriptor both) : in_(std::move(both)), out_(-1) {}

  std::optional<std::string> read(double most_s) override {
    const Deadline deadline(most_s);
    for (;;) {
      const std::size_t end = held_.find('\n', searched_);
      if (std::min(end, held_.size()) > kLongestLine)
        throw LongLine(fmt::format("longer than {} bytes", kLongestLine));
      if (end != std::string::npos) {
        std::string line = held_.substr(0, end);
        held_.erase(0, end + 1);
        searched_ = 0;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        return line;
      }
      searched_ = held_.size();
      if (!wait_for(in_, POLLIN, deadline.left_s()))
        throw ChannelError(fmt::format("no line for {} s", most_s));
      if (!receive()) return std::nullopt;
    }
  }

  void hang_up(double most_s) override {
    const Deadline deadline(most_s);
    const bool tcp = out_.number() < 0;
    if (tcp) ::shutdown(in_.number(), SHUT_WR);
    const bool in_a_line = held_.size() > kLongestLine;
    while (tcp || (in_a_line && held_.find('\n') == std::string::npos)) {
      held_.clear();
      if (!wait_for(in_, POLLIN, std::min(deadline.left_s(), kSilence_s)) || !receive()) return;
    }
  }

  void write(std::string_view line, double most_s) override {
    const Descriptor& out = out_.number() >= 0 ? out_ : in_;
    std::string all(line);
    all += '\n';
    for (std::size_t sent = 0; sent < all.size();) {
      if (!wait_for(out, POLLOUT, most_s))
        throw ChannelError(fmt::format("the other end has read nothing for {} s", most_s));
      const ssize_t n = ::write(out.number(), all.data() + sent, all.size() - sent);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) throw ChannelError(fmt::format("write: {}", std::strerror(errno)));
      sent += static_cast<std::size_t>(n);
    }
  }

 private:
  /// False: the other end has closed.
  bool receive() {
    char bytes[4096];
    const ssize_t got = ::read(in_.number(), bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) return true;
    if (got < 0 && errno != ECONNRESET) throw ChannelError(fmt::format("read: {}", std::strerror(errno)));
    if (got > 0) held_.append(bytes, static_cast<std::size_t>(got));
    return got > 0;
  }

  Descriptor in_;
  Descriptor out_;  // -1: the same
  std::string held_;
  std::size_t searched_ = 0;
};

}  // namespace

std::unique_ptr<Channel> standard_channel() {
  return std::make_unique<Stream>(Descriptor(STDIN_FILENO), Descriptor(STDOUT_FILENO));
}

std::unique_ptr<Channel> accept_tcp(const std::string& address, int port, double most_s,
                                    const std::function<void(int)>& listening) {
  const Descriptor server = bound(SOCK_STREAM, address, port);
  if (::listen(server.number(), 1) != 0) throw ChannelError(fmt::format("listen: {}", std::strerror(errno)));
  listening(port_of(server));
  if (!wait_for(server, POLLIN, most_s)) throw ChannelError(fmt::format("nobody connected for {} s", most_s));
  Descriptor client(::accept4(server.number(), nullptr, nullptr, SOCK_CLOEXEC));
  if (client.number() < 0) throw ChannelError(fmt::format("accept: {}", std::strerror(errno)));
  // Each line waits for the answer to the one before.
  const int yes = 1;
  ::setsockopt(client.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  return std::make_unique<Stream>(std::move(client));
}

}  // namespace whisker::socket
