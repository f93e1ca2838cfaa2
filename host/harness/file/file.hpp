/// Output files. What was there stays until the new content is complete and on the disk.
///
/// "-" is standard output; it, a device and a pipe (/dev/null) cannot be replaced and are written directly.
/// A symbolic link stays a link, and a file keeps its owner and permissions. Errors throw std::runtime_error
/// "cannot write PATH: REASON".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace whisker::files {

/// Replaces the file at `path` by `text`: a reader sees the old or the new file. After an error nothing is
/// left. No signal interrupts it.
void write(const std::string& path, std::string_view text);

/// A file that grows for as long as a command works. It is PATH.part until finish(), also after an error, so
/// that nothing is lost; a second writer of PATH is refused.
class Growing {
 public:
  /// A file that others follow while it grows is PATH at once where there is no content to lose.
  enum class From : bool { part, path_if_new };
  explicit Growing(const std::string& path, From from = From::part);
  ~Growing();  ///< without finish(): PATH.part stays, unless it is empty
  Growing(const Growing&) = delete;
  Growing& operator=(const Growing&) = delete;

  /// What an earlier writer, which did not finish, left in PATH.part. New text follows it.
  const std::string& found() const { return found_; }
  /// Keeps only the first bytes of what was found.
  void keep(std::size_t bytes);
  /// Appends all of `text` or nothing.
  void write(std::string_view text);
  /// PATH becomes this file.
  void finish();

  /// Its name until finish(); "" if it is written directly.
  const std::string& part() const { return part_; }

 private:
  void take_part();
  [[noreturn]] void refuse_second(const std::string& file) const;
  [[noreturn]] void fail(int error) const;

  std::string path_, target_, part_, found_;
  int fd_ = -1;
  std::size_t size_ = 0;
};

/// A file with content is at `path`.
bool has_content(const std::string& path);

}  // namespace whisker::files
