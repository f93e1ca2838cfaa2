#include "host/hil/recorder.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>

#include "host/hil/candump.hpp"

namespace whisker::hil {

Recorder::Recorder(const std::string& file, const std::string& interface)
    : name_(file), interface_(interface) {
  if (file.empty()) return;
  const int copy = file == "-" ? ::dup(STDOUT_FILENO) : -1;
  file_ = copy < 0 ? std::fopen(file.c_str(), "we") : ::fdopen(copy, "w");
  if (file_ == nullptr) throw std::runtime_error("cannot write " + file + ": " + std::strerror(errno));
  std::setvbuf(file_, nullptr, _IOLBF, 1 << 12);
}

Recorder::~Recorder() {
  if (file_ != nullptr) std::fclose(file_);
}

void Recorder::write(const hal::CanFrame& frame) {
  if (file_ == nullptr) return;
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  const auto seconds = static_cast<std::uint64_t>(t.tv_sec);
  LogFrame entry{seconds * 1000000 + static_cast<std::uint64_t>(t.tv_nsec) / 1000, interface_, frame};
  std::fputs((log_line(entry) + "\n").c_str(), file_);
}

void Recorder::close() {
  if (file_ == nullptr) return;
  std::FILE* const file = file_;
  file_ = nullptr;
  const bool failed = std::ferror(file) != 0;
  if (std::fclose(file) != 0 || failed) throw std::runtime_error("cannot write all of " + name_);
}

}  // namespace whisker::hil
