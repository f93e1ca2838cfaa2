#include "host/harness/hil/candump.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <iterator>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace whisker::hil {
namespace {

/// The whole text as a number of at most so many digits.
bool whole(std::string_view text, int base, std::size_t most_digits, std::uint64_t& value) {
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value, base);
  return !text.empty() && text.size() <= most_digits && error == std::errc{} && rest == end;
}

/// (seconds.fraction)
bool take_time(std::string_view text, std::uint64_t& time_us) {
  if (text.size() < 2 || text.back() != ')') return false;
  text = text.substr(1, text.size() - 2);
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos) return false;
  const std::string_view decimals = text.substr(point + 1);
  std::uint64_t seconds = 0, fraction = 0;
  if (!whole(text.substr(0, point), 10, 12, seconds) || !whole(decimals, 10, 9, fraction)) return false;
  for (std::size_t i = decimals.size(); i < 6; ++i) fraction *= 10;
  for (std::size_t i = 6; i < decimals.size(); ++i) fraction /= 10;
  time_us = seconds * 1000000 + fraction;
  return true;
}

constexpr std::uint64_t kErrorFlag = 0x20000000;

bool take_id(std::string_view text, LogFrame& entry) {
  std::uint64_t id = 0;
  entry.frame.extended = text.size() == 8;
  if ((text.size() != 3 && text.size() != 8) || !whole(text, 16, 8, id)) return false;
  if (text.size() == 8 && (id & kErrorFlag) != 0) entry.foreign = "error";
  entry.frame.id = static_cast<std::uint32_t>(id);
  return entry.foreign != nullptr || id <= (entry.frame.extended ? 0x1FFFFFFFU : 0x7FFU);
}

bool take_remote(std::string_view size, LogFrame& entry) {
  std::uint64_t n = 0;
  entry.frame.remote = true;
  if (!size.empty() && (!whole(size, 10, 1, n) || n > 8)) return false;
  entry.frame.size = static_cast<std::uint8_t>(n);
  return true;
}

bool take_data(std::string_view digits, LogFrame& entry) {
  if (digits.size() % 2 != 0 || digits.size() > 16) return false;
  entry.frame.size = static_cast<std::uint8_t>(digits.size() / 2);
  for (std::size_t i = 0; i < entry.frame.size; ++i) {
    std::uint64_t byte = 0;
    if (!whole(digits.substr(2 * i, 2), 16, 2, byte)) return false;
    entry.frame.data[i] = static_cast<std::uint8_t>(byte);
  }
  return true;
}

/// ID#DATA, ID#R with a size or without, ID##FLAGS DATA of CAN FD.
bool take_short(std::string_view text, LogFrame& entry) {
  const std::size_t hash = text.find('#');
  if (!take_id(text.substr(0, hash), entry)) return false;
  text.remove_prefix(hash + 1);
  if (!text.empty() && text.front() == '#') entry.foreign = "CAN FD";
  if (entry.foreign != nullptr) return true;
  // candump -8 appends the length code of a frame whose code is above 8.
  text = text.substr(0, text.find('_'));
  const bool remote = !text.empty() && text.front() == 'R';
  return remote ? take_remote(text.substr(1), entry) : take_data(text, entry);
}

/// ID [SIZE] BYTE BYTE ..., what candump writes without -L; with -8 a length code above 8 as {CODE}.
bool take_long(const std::vector<std::string_view>& words, std::size_t at, LogFrame& entry) {
  const auto is_direction = [](std::string_view w) {
    return w == "RX" || w == "TX" || w == "-" || w == "B" || w == "E";
  };
  while (at < words.size() && is_direction(words[at])) ++at;
  if (at + 2 > words.size() || !take_id(words[at], entry)) return false;
  const std::string_view size = words[at + 1];
  const bool code = size.front() == '{';
  std::uint64_t n = 0;
  if (size.size() < 3 || size.back() != (code ? '}' : ']') || (!code && size.front() != '[') ||
      !whole(size.substr(1, size.size() - 2), code ? 16 : 10, 2, n))
    return false;
  if (entry.foreign != nullptr) return true;
  if (!code && size.size() == 4) return entry.foreign = "CAN FD", true;
  if (at + 2 < words.size() && words[at + 2] == "remote") return take_remote(size.substr(1, 1), entry);
  n = std::min<std::uint64_t>(n, 8);
  std::string digits;
  for (std::size_t i = 0; i < n; ++i) {
    if (at + 2 + i >= words.size() || words[at + 2 + i].size() != 2) return false;
    digits += words[at + 2 + i];
  }
  return take_data(digits, entry);
}

}  // namespace

std::string log_line(const LogFrame& entry) {
  const hal::CanFrame& f = entry.frame;
  std::string line =
      fmt::format("({:010d}.{:06d}) {} ", entry.time_us / 1000000, entry.time_us % 1000000, entry.interface);
  auto out = std::back_inserter(line);
  f.extended ? fmt::format_to(out, "{:08X}#", f.id) : fmt::format_to(out, "{:03X}#", f.id);
  if (f.remote) {
    line += f.size > 0 ? fmt::format("R{}", f.size) : "R";
    return line;
  }
  for (std::uint8_t i = 0; i < f.size; ++i) fmt::format_to(out, "{:02X}", f.data[i]);
  return line;
}

std::optional<LogFrame> parse_log_line(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(" \r"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(" \r", end);
  }
  LogFrame entry;
  std::size_t at = 0;
  if (!words.empty() && words[0].front() == '(') {
    if (!take_time(words[0], entry.time_us)) return std::nullopt;
    at = 1;
  }
  if (words.size() < at + 2) return std::nullopt;
  entry.interface = words[at];
  const bool is_short = at == 1 && words[2].find('#') != std::string_view::npos;
  const bool good = is_short ? take_short(words[2], entry) : take_long(words, at + 1, entry);
  if (!good) return std::nullopt;
  if (entry.foreign == nullptr && entry.frame.remote) entry.foreign = "remote";
  if (entry.foreign == nullptr && entry.frame.extended) entry.foreign = "29-bit";
  return entry;
}

bool LogReader::next(LogFrame& frame) {
  while (lines_.next()) {
    const std::string& line = lines_.line();
    // candump -e explains an error frame in a line of its own.
    if (line.empty() || line.front() == '\t') continue;
    const std::optional<LogFrame> entry = parse_log_line(line);
    if (!entry && lines_.cut() && (line.front() == '(' || line.front() == ' ')) {
      cut_ = lines_.number();
    } else if (!entry) {
      lines_.fail(1, "not a frame as candump writes it");
    } else if (entry->foreign != nullptr) {
      ++skipped_[entry->foreign];
    } else {
      frame = *entry;
      return true;
    }
  }
  return false;
}

Recorder::Recorder(const std::string& file, const std::string& interface)
    : name_(file), interface_(interface) {
  if (file.empty()) return;
  file_.emplace(file, files::Growing::From::path_if_new);
  if (file_->found().empty()) return;
  throw std::runtime_error(fmt::format(
      "cannot write {}: {} is there, of a run that did not end: rename or remove it", file, file_->part()));
}

void Recorder::write(const hal::CanFrame& frame) {
  if (!file_ || lost_) return;
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  const auto seconds = static_cast<std::uint64_t>(t.tv_sec);
  LogFrame entry{seconds * 1000000 + static_cast<std::uint64_t>(t.tv_nsec) / 1000, interface_, frame};
  try {
    file_->write(log_line(entry) + "\n");
  } catch (const std::runtime_error&) {
    lost_ = std::current_exception();
  }
}

void Recorder::close() {
  if (lost_) std::rethrow_exception(lost_);
  if (file_) file_->finish();
  file_.reset();
}

std::string Recorder::keep() {
  if (!file_) return "";
  const std::string place = file_->part().empty() ? name_ : file_->part();
  file_.reset();
  return "; the frames are in " + place;
}

}  // namespace whisker::hil
