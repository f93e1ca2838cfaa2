#include "host/chip/process.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace whisker::chip {
namespace {

constexpr int kPatience_ms = 30000;
constexpr int kGrace_ms = 2000;
constexpr int kNap_ms = 5;

}  // namespace

Process::Process(const std::string& command) : command_(command) {
  int down[2];
  int up[2];
  if (pipe2(down, O_CLOEXEC) != 0) fail("no pipe");
  if (pipe2(up, O_CLOEXEC) != 0) {
    close(down[0]);
    close(down[1]);
    fail("no pipe");
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, down[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, up[1], STDOUT_FILENO);
  // A separate process group, so that the shell's children end with it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string shell = "sh", option = "-c", text = command;
  char* const arguments[] = {shell.data(), option.data(), text.data(), nullptr};
  const int error = posix_spawnp(&child_, "sh", &actions, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(down[0]);
  close(up[1]);
  to_child_ = down[1];
  from_child_ = up[0];
  if (error != 0) {
    close(to_child_);
    close(from_child_);
    fail("no shell");
  }
}

Process::~Process() {
  close(to_child_);
  close(from_child_);
  for (int waited = 0; waited < kGrace_ms; waited += kNap_ms) {
    if (waitpid(child_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(kNap_ms));
  }
  // Not SIGTERM: an emulator whose program ends at the same moment may deadlock.
  kill(-child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

void Process::fail(const char* what) const { throw ChipError(command_ + ": " + what); }

void Process::wait_for(int file, short event) const {
  pollfd waiting{file, event, 0};
  int ready = 0;
  do ready = poll(&waiting, 1, kPatience_ms);
  while (ready < 0 && errno == EINTR);
  if (ready == 0) fail("the chip is silent");
}

void Process::write(const std::uint8_t* from, std::size_t count) {
  // SIGPIPE would end this process; writing to an ended chip must only be an error.
  struct sigaction ignore {};
  struct sigaction before {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &before);
  ssize_t written = 0;
  for (std::size_t done = 0; done < count && written >= 0; done += static_cast<std::size_t>(written)) {
    wait_for(to_child_, POLLOUT);
    written = ::write(to_child_, from + done, count - done);
  }
  sigaction(SIGPIPE, &before, nullptr);
  if (written < 0) fail("the chip has ended");
}

void Process::read(std::uint8_t* to, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    wait_for(from_child_, POLLIN);
    const ssize_t got = ::read(from_child_, to + done, count - done);
    if (got <= 0) fail("the chip has ended");
    done += static_cast<std::size_t>(got);
  }
}

}  // namespace whisker::chip
