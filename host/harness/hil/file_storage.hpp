#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "hal/storage.hpp"

namespace whisker::hil {

/// The file is no storage, or cannot be read or written; what() is the reason in one line.
class FileStorageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Two slots of 8 KB in a file, behind a line that names it. What read() returns is on the disk.
class FileStorage final : public hal::Storage {
 public:
  /// Creates the file if it is not there, empty, or left unfinished by a process that was ended. Throws
  /// FileStorageError, also for any other file, and for one that another process has open.
  explicit FileStorage(const std::string& path);
  ~FileStorage();
  FileStorage(const FileStorage&) = delete;
  FileStorage& operator=(const FileStorage&) = delete;

  std::uint16_t size() const noexcept override { return kSize; }
  bool read(std::uint8_t slot, std::uint16_t at, std::uint8_t* out, std::uint16_t size) noexcept override;
  bool erase(std::uint8_t slot) noexcept override;
  bool write(std::uint8_t slot, std::uint16_t at, const std::uint8_t* data,
             std::uint16_t size) noexcept override;

 private:
  static constexpr std::uint16_t kSize = 8192;
  bool synced() noexcept;

  int file_ = -1;
  bool dirty_ = false;
};

}  // namespace whisker::hil
