#include "host/cli/keys.hpp"

#include <signal.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "host/cli/exit_status.hpp"

namespace whisker::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kHold_s = 0.35;  // longer than the pause before a key repeats, nearly
constexpr std::chrono::milliseconds kMostLag{100};

termios g_before, g_raw;

/// Ctrl-Z, and Ctrl-\\, which nothing survives: the shell gets its terminal as it was.
void leave(int number) {
  tcsetattr(STDIN_FILENO, TCSANOW, &g_before);
  if (number != SIGTSTP) _exit(128 + number);
  raise(SIGSTOP);
  tcsetattr(STDIN_FILENO, TCSANOW, &g_raw);
}

}  // namespace

struct Keys::Terminal {
  Clock::time_point start = Clock::now();
};

Keys::Keys(double speed_mps, double turn_radps, const Interrupt&)
    : terminal_(std::make_unique<Terminal>()), speed_mps_(speed_mps), turn_radps_(turn_radps) {
  if (isatty(STDIN_FILENO) == 0 || tcgetattr(STDIN_FILENO, &g_before) != 0) {
    throw UsageError("--keys: standard input is no terminal");
  }
  g_raw = g_before;
  g_raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  g_raw.c_cc[VMIN] = 0;
  g_raw.c_cc[VTIME] = 0;
  signal(SIGTSTP, leave);
  signal(SIGQUIT, leave);
  tcsetattr(STDIN_FILENO, TCSANOW, &g_raw);
}

Keys::~Keys() {
  tcsetattr(STDIN_FILENO, TCSANOW, &g_before);
  signal(SIGTSTP, SIG_DFL);
  signal(SIGQUIT, SIG_DFL);
}

void Keys::press(char key, double t_s) {
  const double v = speed_mps_, w = turn_radps_;
  switch (key) {
    case 'w':
    case 'A': twist_ = {v, 0}; break;
    case 's':
    case 'B': twist_ = {-v / 2, 0}; break;
    case 'd':
    case 'C': twist_ = {twist_.forward_mps > 0 ? v : 0, -w}; break;
    case 'a':
    case 'D': twist_ = {twist_.forward_mps > 0 ? v : 0, w}; break;
    case ' ': twist_ = {}; break;
    case 'q': ended_ = true; break;
    default: return;
  }
  until_s_ = t_s + kHold_s;
}

guard::Twist Keys::ask(const guard::Sight& sight) {
  const auto due = terminal_->start +
                   std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(sight.t_s));
  // What a stopped process missed is not made up for.
  const auto late = Clock::now() - due;
  if (late > kMostLag) terminal_->start += late;
  std::this_thread::sleep_until(due);
  char key = 0;
  while (read(STDIN_FILENO, &key, 1) == 1) press(key, sight.t_s);
  if (sight.t_s > until_s_) twist_ = {};
  return twist_;
}

}  // namespace whisker::cli
