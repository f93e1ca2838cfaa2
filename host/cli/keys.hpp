/// Drives with the keyboard of a terminal.
#pragma once

#include <memory>

#include "host/cli/output.hpp"
#include "host/lab/guard/operator.hpp"

namespace whisker::cli {

/// Arrow keys or w, a, s, d hold for a third of a second; space stops; q ends. In real time. Throws
/// UsageError unless standard input is a terminal, whose settings come back at the end, also while Ctrl-Z
/// stops the command. Only with an Interrupt, so that no signal ends the command without them.
class Keys final : public guard::Operator {
 public:
  Keys(double speed_mps, double turn_radps, const Interrupt&);
  ~Keys() override;
  Keys(const Keys&) = delete;
  Keys& operator=(const Keys&) = delete;

  guard::Twist ask(const guard::Sight& sight) override;
  bool ended() const { return ended_; }

 private:
  void press(char key, double t_s);

  struct Terminal;
  std::unique_ptr<Terminal> terminal_;
  double speed_mps_, turn_radps_;
  guard::Twist twist_;
  double until_s_ = 0;
  bool ended_ = false;
};

}  // namespace whisker::cli
