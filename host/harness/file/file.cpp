#include "host/harness/file/file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

namespace whisker::files {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_with(const std::string& path, int error, const std::string& more = "") {
  throw std::runtime_error(
      fmt::format("cannot write {}: {}{}", path, std::generic_category().message(error), more));
}

/// 0, or the errno of the first write that failed.
int write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

struct Place {
  std::string target;  ///< the path, behind all links
  int direct = -1;     ///< a device or a pipe, open for writing
  struct stat old {};  ///< st_nlink 0: there is no file
};

constexpr int kMostLinks = 40;

Place place_of(const std::string& path) {
  Place place;
  if (path == "-") {
    place.direct = ::dup(STDOUT_FILENO);
    if (place.direct < 0) fail_with("standard output", errno);
    return place;
  }
  fs::path target = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, error); ++i) {
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  place.target = target.string();
  if (::stat(path.c_str(), &place.old) != 0) {
    place.old = {};
    return place;
  }
  if (S_ISDIR(place.old.st_mode)) fail_with(path, EISDIR);
  if (S_ISREG(place.old.st_mode)) return place;
  place.direct = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (place.direct < 0) fail_with(path, errno);
  return place;
}

/// The new file takes the old one's place once it is on the disk. 0 or errno.
int replace(int fd, const std::string& part, const Place& place) {
  // Only root may give a file away; for others it is theirs anyway.
  const bool same_owner = place.old.st_nlink > 0 && ::fchown(fd, place.old.st_uid, place.old.st_gid) == 0;
  const mode_t mode = place.old.st_mode & (same_owner ? 07777U : 0777U);
  if (place.old.st_nlink > 0 && ::fchmod(fd, mode) != 0) return errno;
  if (::fsync(fd) != 0 || ::rename(part.c_str(), place.target.c_str()) != 0) return errno;
  const fs::path folder = fs::path(place.target).parent_path();
  const int entry = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (entry >= 0) {
    ::fsync(entry);
    ::close(entry);
  }
  return 0;
}

class NoSignals {
 public:
  NoSignals() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~NoSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  NoSignals(const NoSignals&) = delete;
  NoSignals& operator=(const NoSignals&) = delete;

 private:
  sigset_t before_{};
};

constexpr int kMostNames = 1000;

/// Another process has it as its part.
bool is_growing(const std::string& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool locked = ::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(fd);
  return locked;
}

/// A new file beside the target, whose name nobody else has. -1: errno says why.
int create_beside(const std::string& target, std::string& name) {
  for (int i = 0; i < kMostNames; ++i) {
    name = fmt::format("{}.{}-{}.part", target, ::getpid(), i);
    const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd >= 0 || errno != EEXIST) return fd;
  }
  return -1;
}

}  // namespace

void write(const std::string& path, std::string_view text) {
  if (path == "-" && std::fflush(stdout) != 0) fail_with("standard output", errno);
  const Place place = place_of(path);
  if (place.direct >= 0) {
    int error = write_all(place.direct, text);
    if (::close(place.direct) != 0 && error == 0) error = errno;
    if (error != 0) fail_with(path == "-" ? "standard output" : path, error);
    return;
  }
  const NoSignals whole;
  std::string part;
  const int fd = create_beside(place.target, part);
  if (fd < 0) fail_with(path, errno);
  int error = write_all(fd, text);
  if (error == 0) error = replace(fd, part, place);
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error == 0) return;
  ::unlink(part.c_str());
  fail_with(path, error);
}

Growing::Growing(const std::string& path, From from) : path_(path) {
  const Place place = place_of(path);
  fd_ = place.direct;
  if (fd_ >= 0) return;
  target_ = place.target;
  part_ = from == From::path_if_new && !has_content(path) ? target_ : target_ + ".part";
  if (is_growing(target_)) refuse_second(target_);
  fd_ = ::open(part_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (fd_ < 0) {
    const int error = errno;
    throw std::runtime_error(
        fmt::format("cannot write {}: {}: {}", path_, part_,
                    error == ELOOP ? "is a symbolic link" : std::generic_category().message(error)));
  }
  try {
    take_part();
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

void Growing::refuse_second(const std::string& file) const {
  throw std::runtime_error(fmt::format("cannot write {}: another process is writing {}", path_, file));
}

/// The file belongs to another process while that process holds its lock. After that, it does so if `part_`
/// no longer names this file: it was renamed or removed between open() and flock().
void Growing::take_part() {
  const bool locked = ::flock(fd_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  struct stat ours {
  }, named{};
  const bool same = locked && ::fstat(fd_, &ours) == 0 && ::lstat(part_.c_str(), &named) == 0 &&
                    ours.st_dev == named.st_dev && ours.st_ino == named.st_ino;
  if (!same) refuse_second(part_);
  if (!S_ISREG(ours.st_mode) || ours.st_nlink != 1) {
    throw std::runtime_error(fmt::format("cannot write {}: {} is no file of its own", path_, part_));
  }
  std::array<char, 1 << 16> piece{};
  for (;;) {
    const ssize_t n = ::read(fd_, piece.data(), piece.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    if (n == 0) break;
    found_.append(piece.data(), static_cast<std::size_t>(n));
  }
  size_ = found_.size();
}

Growing::~Growing() {
  if (fd_ < 0) return;
  if (!part_.empty() && part_ != target_ && size_ == 0) ::unlink(part_.c_str());
  ::close(fd_);
}

void Growing::keep(std::size_t bytes) {
  if (part_.empty() || bytes >= size_) return;
  if (::ftruncate(fd_, static_cast<off_t>(bytes)) != 0) fail(errno);
  size_ = bytes;
  found_.resize(bytes);
}

void Growing::write(std::string_view text) {
  const int error = write_all(fd_, text);
  if (error == 0) {
    size_ += text.size();
    return;
  }
  if (!part_.empty() && ::ftruncate(fd_, static_cast<off_t>(size_)) != 0) fail(errno);
  fail(error);
}

void Growing::finish() {
  if (part_.empty()) {
    const int fd = std::exchange(fd_, -1);
    if (::close(fd) != 0) fail(errno);
    return;
  }
  const NoSignals whole;
  // The lock stays until the file has its final name.
  if (const int error = replace(fd_, part_, place_of(path_))) fail(error);
  part_.clear();
  const int fd = std::exchange(fd_, -1);
  if (::close(fd) != 0) fail(errno);
}

void Growing::fail(int error) const {
  const std::string kept = part_.empty() || size_ == 0 ? "" : fmt::format("; {} keeps what there is", part_);
  fail_with(path_ == "-" ? "standard output" : path_, error, kept);
}

bool has_content(const std::string& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && fs::file_size(path, error) > 0;
}

}  // namespace whisker::files
