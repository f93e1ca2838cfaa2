#include "host/cli/interrupt.hpp"

namespace whisker::cli {
namespace {

volatile sig_atomic_t g_noted = 0;

void note(int) { g_noted = 1; }

}  // namespace

Interrupt::Interrupt() {
  g_noted = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &old_int_);
  sigaction(SIGTERM, &action, &old_term_);
}

Interrupt::~Interrupt() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
}

bool Interrupt::noted() const { return g_noted != 0; }

}  // namespace whisker::cli
