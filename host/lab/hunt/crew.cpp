#include "host/lab/hunt/crew.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>

namespace whisker::hunt {
namespace {

constexpr rlim_t kMostSeconds = 120;  // of processor time: a job that needs more hangs
constexpr int kThrew = 1;

void write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno != EINTR) ::_exit(kThrew);
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
}

[[noreturn]] void work(int fd, const Job& job) {
  const rlimit limit{kMostSeconds, kMostSeconds}, no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &limit);
  ::setrlimit(RLIMIT_CORE, &no_core);
  try {
    job([fd](std::string_view text) { write_all(fd, text); });
  } catch (const std::exception& e) {
    // The text is not part of what the job said.
    write_all(fd, fmt::format("{}{}", '\0', e.what()));
    ::_exit(kThrew);
  }
  ::_exit(0);
}

/// Of a process that ended with this status.
std::string death(int status, std::string& text) {
  if (WIFSIGNALED(status)) return fmt::format("signal {}", WTERMSIG(status));
  if (WEXITSTATUS(status) == 0) return "";
  const std::size_t mark = text.rfind('\0');
  if (mark == std::string::npos) return fmt::format("status {}", WEXITSTATUS(status));
  const std::string why = text.substr(mark + 1);
  text.resize(mark);
  return why;
}

/// False at the end of the stream.
bool take(int fd, std::string& text) {
  char buffer[65536];
  const ssize_t n = ::read(fd, buffer, sizeof buffer);
  if (n > 0) text.append(buffer, static_cast<std::size_t>(n));
  return n > 0 || (n < 0 && errno == EINTR);
}

}  // namespace

Crew::~Crew() {
  for (const Hand& hand : hands_) {
    ::kill(hand.process, SIGKILL);
    ::close(hand.pipe);
    ::waitpid(hand.process, nullptr, 0);
  }
}

void Crew::start(std::uint64_t id, const Job& job) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t process = ::fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (process == 0) {
    ::close(ends[0]);
    work(ends[1], job);
  }
  ::close(ends[1]);
  hands_.push_back({{id, {}, {}}, process, ends[0]});
}

std::vector<Ended> Crew::wait() {
  std::vector<pollfd> ready;
  for (const Hand& hand : hands_) ready.push_back({hand.pipe, POLLIN, 0});
  ::poll(ready.data(), ready.size(), 100);
  std::vector<Ended> ended;
  std::vector<Hand> busy;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    if (ready[i].revents == 0 || take(hand.pipe, hand.ended.text)) {
      busy.push_back(std::move(hand));
      continue;
    }
    int status = 0;
    ::close(hand.pipe);
    while (::waitpid(hand.process, &status, 0) < 0 && errno == EINTR) {
    }
    hand.ended.death = death(status, hand.ended.text);
    ended.push_back(std::move(hand.ended));
  }
  hands_ = std::move(busy);
  return ended;
}

Ended isolated(const Job& job) {
  Crew crew;
  crew.start(0, job);
  while (true) {
    std::vector<Ended> ended = crew.wait();
    if (!ended.empty()) return std::move(ended.front());
  }
}

}  // namespace whisker::hunt
