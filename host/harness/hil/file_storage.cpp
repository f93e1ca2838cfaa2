#include "host/harness/hil/file_storage.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/types.h>
#include <unistd.h>

#include <fmt/format.h>

namespace whisker::hil {
namespace {

constexpr std::string_view kHead = "whisker storage\n";
constexpr std::uint8_t kErased = 0xFF;
constexpr std::string_view kUnfinished{"\0\xFF", 2};

bool write_all(int file, const void* data, std::size_t size, off_t at) {
  return pwrite(file, data, size, at) == static_cast<ssize_t>(size);
}

off_t place(std::uint8_t slot, std::uint16_t at, std::uint16_t slot_bytes) {
  return static_cast<off_t>(kHead.size()) + off_t{slot} * slot_bytes + at;
}

}  // namespace

FileStorage::FileStorage(const std::string& path) {
  const auto fail = [&](const std::string& reason) {
    if (file_ >= 0) close(file_);
    throw FileStorageError(fmt::format("{}: {}", path, reason));
  };
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) fail(std::strerror(errno));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) fail("another controller uses it");
  std::string bytes(static_cast<std::size_t>(place(kSlots, 0, kSize)) + 1, '\0');
  const ssize_t size = pread(file_, bytes.data(), bytes.size(), 0);
  if (size < 0) fail(std::strerror(errno));
  const bool whole = static_cast<std::size_t>(size) == bytes.size() - 1;
  bytes.resize(static_cast<std::size_t>(size));
  if (whole && bytes.rfind(kHead, 0) == 0) return;
  // Its head is written last: without it, only erased bytes and holes are those of an unfinished one.
  const bool unfinished =
      size <= place(kSlots, 0, kSize) && bytes.find_first_not_of(kUnfinished) == std::string::npos;
  if (!unfinished) fail("not a storage of whisker controller: name another file");
  if (!erase(0) || !erase(1) || !synced() || !write_all(file_, kHead.data(), kHead.size(), 0)) {
    fail(std::strerror(errno));
  }
}

FileStorage::~FileStorage() { close(file_); }

bool FileStorage::synced() noexcept {
  if (dirty_ && fdatasync(file_) != 0) return false;
  dirty_ = false;
  return true;
}

bool FileStorage::read(std::uint8_t slot, std::uint16_t at, std::uint8_t* out, std::uint16_t size) noexcept {
  return synced() && pread(file_, out, size, place(slot, at, kSize)) == ssize_t{size};
}

bool FileStorage::erase(std::uint8_t slot) noexcept {
  std::array<std::uint8_t, kSize> bytes;
  bytes.fill(kErased);
  return write(slot, 0, bytes.data(), kSize);
}

bool FileStorage::write(std::uint8_t slot, std::uint16_t at, const std::uint8_t* data,
                        std::uint16_t size) noexcept {
  dirty_ = true;
  return write_all(file_, data, size, place(slot, at, kSize));
}

}  // namespace whisker::hil
