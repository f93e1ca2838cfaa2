#include "host/harness/hil/candump.hpp"

#include <charconv>
#include <ctime>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

namespace whisker::hil {
namespace {

/// Removes a whole number from the front, up to and including `end`.
bool take(std::string_view& text, char end, int base, std::size_t most_digits, std::uint64_t& value) {
  const std::size_t length = end == 0 ? text.size() : text.find(end);
  if (length == std::string_view::npos || length == 0 || length > most_digits) return false;
  const char* const stop = text.data() + length;
  const auto [rest, error] = std::from_chars(text.data(), stop, value, base);
  if (error != std::errc{} || rest != stop) return false;
  text.remove_prefix(end == 0 ? length : length + 1);
  return true;
}

bool take_data(std::string_view text, hal::CanFrame& frame) {
  if (!text.empty() && text.front() == 'R') {
    frame.remote = true;
    std::uint64_t size = 0;
    text.remove_prefix(1);
    if (!text.empty() && (!take(text, 0, 10, 1, size) || size > 8)) return false;
    frame.size = static_cast<std::uint8_t>(size);
    return true;
  }
  if (text.size() % 2 != 0 || text.size() > 16) return false;
  frame.size = static_cast<std::uint8_t>(text.size() / 2);
  for (std::size_t i = 0; i < frame.size; ++i) {
    std::string_view digits = text.substr(2 * i, 2);
    std::uint64_t byte = 0;
    if (!take(digits, 0, 16, 2, byte)) return false;
    frame.data[i] = static_cast<std::uint8_t>(byte);
  }
  return true;
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
  LogFrame entry;
  std::uint64_t seconds = 0, micros = 0, id = 0;
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  if (line.empty() || line.front() != '(') return std::nullopt;
  line.remove_prefix(1);
  if (!take(line, '.', 10, 12, seconds) || !take(line, ')', 10, 6, micros)) return std::nullopt;
  if (line.empty() || line.front() != ' ') return std::nullopt;
  line.remove_prefix(1);
  const std::size_t space = line.find(' ');
  if (space == std::string_view::npos || space == 0) return std::nullopt;
  entry.interface = line.substr(0, space);
  line.remove_prefix(space + 1);
  // candump -L may end a line with the direction.
  line = line.substr(0, line.find(' '));
  const std::size_t digits = line.find('#');
  if (digits != 3 && digits != 8) return std::nullopt;
  if (!take(line, '#', 16, 8, id) || id > (digits == 8 ? 0x1FFFFFFFU : 0x7FFU)) return std::nullopt;
  entry.time_us = seconds * 1000000 + micros;
  entry.frame.id = static_cast<std::uint32_t>(id);
  entry.frame.extended = digits == 8;
  if (!take_data(line, entry.frame)) return std::nullopt;
  return entry;
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
