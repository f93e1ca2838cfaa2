#include "tests/view/http.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace whisker::view::testing {

std::string Answer::header(std::string_view name) const {
  const std::string key = "\r\n" + std::string(name) + ": ";
  const std::size_t at = head.find(key);
  if (at == std::string::npos) return "";
  const std::size_t from = at + key.size();
  return head.substr(from, head.find("\r\n", from) - from);
}

Line::Line(int port, int receive_buffer) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer > 0) {
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
}

Line::~Line() { ::close(socket_); }

std::size_t Line::send(std::string_view bytes) const {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    pollfd ready{socket_, POLLOUT, 0};
    if (poll(&ready, 1, 5000) <= 0) break;
    const std::string_view rest = bytes.substr(sent);
    const ssize_t n = ::send(socket_, rest.data(), rest.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n <= 0) break;
    sent += static_cast<std::size_t>(n);
  }
  return sent;
}

std::string Line::read_some(std::chrono::milliseconds patience) const {
  char bytes[4096];
  pollfd ready{socket_, POLLIN, 0};
  if (poll(&ready, 1, static_cast<int>(patience.count())) <= 0) return "";
  const ssize_t n = recv(socket_, bytes, sizeof bytes, 0);
  return {bytes, n > 0 ? static_cast<std::size_t>(n) : 0U};
}

std::string Line::read_all() const {
  std::string all;
  for (std::string some = read_some(); !some.empty(); some = read_some()) all += some;
  return all;
}

bool Line::is_left(std::chrono::milliseconds patience) const {
  const auto until = std::chrono::steady_clock::now() + patience;
  char bytes[4096];
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    pollfd ready{socket_, POLLIN, 0};
    if (left.count() <= 0 || poll(&ready, 1, static_cast<int>(left.count())) <= 0) return false;
    if (recv(socket_, bytes, sizeof bytes, 0) <= 0) return true;
  }
}

std::string ask(int port, const std::string& path, const std::string& more) {
  const std::string host =
      more.find("Host:") == std::string::npos ? "Host: 127.0.0.1:" + std::to_string(port) + "\r\n" : "";
  return "GET " + path + " HTTP/1.1\r\n" + host + more;
}

Answer answer_of(const std::string& bytes) {
  Answer answer;
  const std::size_t end = bytes.find("\r\n\r\n");
  if (bytes.rfind("HTTP/1.1 ", 0) != 0 || end == std::string::npos) return answer;
  answer.status = std::stoi(bytes.substr(9, 3));
  answer.head = bytes.substr(0, end + 2);
  answer.body = bytes.substr(end + 4);
  return answer;
}

Answer get(int port, const std::string& path, const std::string& more) {
  const Line line(port);
  line.send(ask(port, path, more) + "\r\n");
  return answer_of(line.read_all());
}

}  // namespace whisker::view::testing
