#include "host/lab/view/socket.hpp"

#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/core.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "host/lab/view/server.hpp"

namespace whisker::view {
namespace {

constexpr int kWaiting = 512;  // connections that the kernel accepts in advance

bool is_not_now(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

Moved moved(ssize_t n) {
  if (n >= 0) return {false, static_cast<std::size_t>(n)};
  return {!is_not_now(errno), 0};
}

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses resolved(const std::string& address, int port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* all = nullptr;
  if (address.empty() || getaddrinfo(address.c_str(), fmt::format("{}", port).c_str(), &wanted, &all) != 0) {
    all = nullptr;
  }
  return {all, [](addrinfo* list) {
            if (list != nullptr) freeaddrinfo(list);
          }};
}

/// No socket: errno says why.
Socket listening(const addrinfo& at) {
  Socket socket(::socket(at.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, at.ai_protocol));
  const int on = 1;
  if (!socket || setsockopt(socket.descriptor(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) != 0 ||
      bind(socket.descriptor(), at.ai_addr, at.ai_addrlen) != 0 ||
      listen(socket.descriptor(), kWaiting) != 0) {
    const int error = errno;
    socket.close();
    errno = error;
  }
  return socket;
}

}  // namespace

Socket& Socket::operator=(Socket&& other) noexcept {
  if (this == &other) return *this;
  close();
  descriptor_ = other.release();
  return *this;
}

void Socket::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

int Socket::release() { return std::exchange(descriptor_, -1); }

Moved receive(const Socket& from, char* bytes, std::size_t most) {
  const ssize_t n = recv(from.descriptor(), bytes, most, 0);
  return n == 0 ? Moved{true, 0} : moved(n);
}

Moved send(const Socket& to, std::string_view bytes) {
  return moved(::send(to.descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL));
}

void end_sending(const Socket& socket) { shutdown(socket.descriptor(), SHUT_WR); }

Socket listen_on(const std::string& address, int port) {
  const Addresses all = resolved(address, port);
  std::string why = "no such address";
  for (const addrinfo* at = all.get(); at != nullptr; at = at->ai_next) {
    if (Socket socket = listening(*at)) return socket;
    why = std::generic_category().message(errno);
  }
  throw ServerError(fmt::format("cannot serve on {}, port {}: {}", address, port, why));
}

int port_of(const Socket& listening) {
  sockaddr_storage at{};
  socklen_t size = sizeof at;
  char port[NI_MAXSERV] = {};
  getsockname(listening.descriptor(), reinterpret_cast<sockaddr*>(&at), &size);
  getnameinfo(reinterpret_cast<const sockaddr*>(&at), size, nullptr, 0, port, sizeof port, NI_NUMERICSERV);
  return std::stoi(port);
}

Accepted accept_one(const Socket& listening, Socket& client) {
  Socket socket(accept4(listening.descriptor(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket) {
    return errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM ? Accepted::no_descriptor
                                                                                     : Accepted::none;
  }
  const int on = 1;
  setsockopt(socket.descriptor(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  client = std::move(socket);
  return Accepted::one;
}

Bell::Bell() : event_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!event_) {
    throw ServerError(fmt::format("cannot serve: {}", std::generic_category().message(errno)));
  }
}

void Bell::ring() const { eventfd_write(event_.descriptor(), 1); }

}  // namespace whisker::view
