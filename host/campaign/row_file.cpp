#include "host/campaign/row_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "host/campaign/row_text.hpp"

namespace whisker::campaign {

RowFile::RowFile(const std::string& path) : path_(path), target_(path) {
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
    fd_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  }
  if (fd_ < 0) {
    const int error = errno;
    part_.clear();
    fail(error);
  }
  write_line(kRowHeader);
}

RowFile::~RowFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!part_.empty()) ::unlink(part_.c_str());
}

void RowFile::add(const Row& row) { write_line(to_csv(row)); }

void RowFile::finish() {
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0) fail(errno);
  if (part_.empty()) return;
  if (::rename(part_.c_str(), target_.c_str()) != 0) fail(errno);
  part_.clear();
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
