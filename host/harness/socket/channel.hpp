/// Lines to and from one simulator.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace whisker::socket {

constexpr std::size_t kLongestLine = 65536;  ///< bytes

/// What the other end did not do in time, or what this machine refused; what() is one line.
struct ChannelError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A line of more than kLongestLine bytes; what() is one line.
struct LongLine : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Channel {
 public:
  virtual ~Channel() = default;
  /// The next line without its end; none: the other end has closed. Throws LongLine, and ChannelError if no
  /// whole line comes for that long.
  virtual std::optional<std::string> read(double most_s) = 0;
  /// Drops what the other end still says, until it closes too or falls silent or, where nothing is lost by
  /// closing, until the end of a LongLine. TCP would take the last answer back if lines were left unread.
  virtual void hang_up(double /*most_s*/) {}
  /// Throws ChannelError if the other end takes nothing for that long.
  virtual void write(std::string_view line, double most_s) = 0;
};

/// Standard input and output.
std::unique_ptr<Channel> standard_channel();
/// A TCP server for one client. Waits for it at most this long. listening() is called with the port.
std::unique_ptr<Channel> accept_tcp(const std::string& address, int port, double most_s,
                                    const std::function<void(int)>& listening);
/// One datagram a line. The sender of the first one is the other end; others are not heard.
std::unique_ptr<Channel> bind_udp(const std::string& address, int port,
                                  const std::function<void(int)>& listening);

}  // namespace whisker::socket
