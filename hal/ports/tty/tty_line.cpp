#include "hal/ports/tty/tty_line.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

namespace whisker::hal::tty {
namespace {

constexpr std::chrono::milliseconds kBetweenTries{50};

/// The file type at a path. False if it does not exist or access is denied.
bool kind_at(const std::string& path, mode_t& kind) noexcept {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return false;
  kind = found.st_mode & S_IFMT;
  return true;
}

unsigned speed_of(int baud) {
  constexpr std::pair<int, speed_t> kSpeeds[] = {
      {9600, B9600},       {19200, B19200},     {38400, B38400},     {57600, B57600},     {115200, B115200},
      {230400, B230400},   {460800, B460800},   {500000, B500000},   {921600, B921600},   {1000000, B1000000},
      {1500000, B1500000}, {2000000, B2000000}, {3000000, B3000000}, {4000000, B4000000},
  };
  for (const auto& [number, speed] : kSpeeds) {
    if (number == baud) return speed;
  }
  throw TtyError(std::to_string(baud) + " baud: not a usual speed of a serial line");
}

}  // namespace

TtyLine::TtyLine(std::string path, int baud) : path_(std::move(path)), speed_(speed_of(baud)) {
  mode_t kind = 0;
  if (kind_at(path_, kind) && kind != S_IFCHR && kind != S_IFSOCK) {
    throw TtyError(path_ + ": neither a serial device nor a socket");
  }
}

TtyLine::~TtyLine() {
  if (file_ >= 0) close(file_);
}

bool TtyLine::connect_to() noexcept {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    return false;
  }
  path_.copy(address.sun_path, path_.size());
  file_ = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  return file_ >= 0 && connect(file_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
}

bool TtyLine::open_device() noexcept {
  file_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios mode{};
  if (file_ < 0 || tcgetattr(file_, &mode) != 0) return false;
  cfmakeraw(&mode);
  mode.c_cflag |= CLOCAL | CREAD;
  // With a minimum of one byte per read, a read of zero bytes means that the other end closed.
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
  return cfsetspeed(&mode, speed_) == 0 && tcsetattr(file_, TCSANOW, &mode) == 0 &&
         tcflush(file_, TCIOFLUSH) == 0;
}

void TtyLine::open() noexcept {
  mode_t kind = 0;
  errno = 0;
  const bool found = kind_at(path_, kind);
  is_socket_ = kind == S_IFSOCK;
  if (found && (is_socket_ ? connect_to() : open_device())) return;
  error_ = errno;
  if (file_ >= 0) close(file_);
  file_ = -1;
}

void TtyLine::lose() noexcept {
  close(file_);
  file_ = -1;
  error_ = EPIPE;
  just_lost_ = true;
  came_first_ = came_end_ = 0;
}

bool TtyLine::ready() noexcept {
  if (file_ >= 0) return true;
  if (just_lost_) {
    just_lost_ = false;
    return false;
  }
  const Clock::time_point now = Clock::now();
  if (tried_ && now - tried_at_ < kBetweenTries) return false;
  tried_ = true;
  tried_at_ = now;
  open();
  return file_ >= 0;
}

size_t TtyLine::take(uint8_t* to, size_t room) noexcept {
  if (file_ < 0) return 0;
  if (came_first_ == came_end_) {
    const ssize_t got = read(file_, came_, sizeof came_);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) lose();
    if (got <= 0) return 0;
    came_first_ = 0;
    came_end_ = static_cast<size_t>(got);
  }
  const size_t count = std::min(room, came_end_ - came_first_);
  std::memcpy(to, came_ + came_first_, count);
  came_first_ += count;
  return count;
}

size_t TtyLine::offer(const uint8_t* from, size_t count) noexcept {
  if (file_ < 0 || count == 0) return 0;
  const ssize_t put = is_socket_ ? ::send(file_, from, count, MSG_NOSIGNAL) : write(file_, from, count);
  if (put < 0 && errno != EAGAIN && errno != EINTR) lose();
  return put < 0 ? 0 : static_cast<size_t>(put);
}

std::string TtyLine::waits_for() const {
  if (file_ >= 0) return {};
  return path_ + ": " + (error_ == EPIPE ? "the other end has gone" : std::strerror(error_));
}

}  // namespace whisker::hal::tty
