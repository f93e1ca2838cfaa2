#include "host/campaign/row_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "host/campaign/row_text.hpp"

namespace whisker::campaign {

RowFile::RowFile(const std::string& path) : path_(path), target_(path) {
  if (path == "-") {
    fd_ = ::dup(STDOUT_FILENO);
    if (fd_ < 0) fail(errno);
    write_line(kRowHeader);
    return;
  }
  struct stat existing {};
  const bool exists = ::stat(path.c_str(), &existing) == 0;
  if (exists && S_ISDIR(existing.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(existing.st_mode)) {
    fd_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    std::error_code error;
    if (exists) target_ = std::filesystem::canonical(path, error).string();
    if (error) fail(error.value());
    part_ = target_ + ".part";
    fd_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  }
  if (fd_ < 0) {
    const int error = errno;
    part_.clear();
    fail(error);
  }
  if (!part_.empty()) take_part();
  write_line(kRowHeader);
}

/// The file belongs to another process while that process holds its lock. After that, it does so if `part_`
/// no longer names this file: it was renamed or removed between open() and flock().
void RowFile::take_part() {
  const bool locked = ::flock(fd_, LOCK_EX | LOCK_NB) == 0;
  struct stat ours {
  }, named{};
  const bool same = locked && ::fstat(fd_, &ours) == 0 && ::stat(part_.c_str(), &named) == 0 &&
                    ours.st_dev == named.st_dev && ours.st_ino == named.st_ino;
  if (same && ::ftruncate(fd_, 0) == 0) return;
  const std::string part = std::exchange(part_, "");
  ::close(std::exchange(fd_, -1));
  throw std::runtime_error(fmt::format("cannot write {}: another campaign is writing {}", path_, part));
}

RowFile::~RowFile() {
  if (!part_.empty()) ::unlink(part_.c_str());
  if (fd_ >= 0) ::close(fd_);
}

void RowFile::add(const Row& row) { write_line(to_csv(row)); }

void RowFile::finish() {
  // Closing the copy reports delayed write errors; the lock stays until the file has its final name.
  const int copy = ::dup(fd_);
  if (copy < 0 || ::close(copy) != 0) fail(errno);
  if (!part_.empty() && ::rename(part_.c_str(), target_.c_str()) != 0) fail(errno);
  part_.clear();
  ::close(std::exchange(fd_, -1));
}

void RowFile::write_line(std::string_view line) {
  const std::string text = fmt::format("{}\n", line);
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t n = ::write(fd_, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
}

void RowFile::fail(int error) const {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path_, std::generic_category().message(error)));
}

}  // namespace whisker::campaign
