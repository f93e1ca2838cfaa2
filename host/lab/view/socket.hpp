/// Non-blocking sockets that are not inherited by other programs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace whisker::view {

/// A descriptor, closed with this object.
class Socket {
 public:
  Socket() = default;
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  ~Socket() { close(); }
  Socket(Socket&& other) noexcept : descriptor_(other.release()) {}
  Socket& operator=(Socket&& other) noexcept;

  int descriptor() const { return descriptor_; }
  explicit operator bool() const { return descriptor_ >= 0; }
  void close();

 private:
  int release();

  int descriptor_ = -1;
};

/// Result of a call: 0 bytes for "not now".
struct Moved {
  bool ended = false;  ///< the other end is closed, or has sent its last byte
  std::size_t bytes = 0;
};

Moved receive(const Socket& from, char* bytes, std::size_t most);
Moved send(const Socket& to, std::string_view bytes);
/// Ends the sent data; the other end may continue to send.
void end_sending(const Socket& socket);

/// Port 0: any free one. Throws ServerError.
Socket listen_on(const std::string& address, int port);
int port_of(const Socket& listening);

enum class Accepted { one, none, no_descriptor };
Accepted accept_one(const Socket& listening, Socket& client);

/// Wakes a poll().
class Bell {
 public:
  /// Throws ServerError.
  Bell();
  void ring() const;
  int descriptor() const { return event_.descriptor(); }
  void close() { event_.close(); }

 private:
  Socket event_;
};

}  // namespace whisker::view
