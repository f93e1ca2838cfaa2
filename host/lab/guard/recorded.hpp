/// Commands from a CSV file with the columns t_s, v_mps and omega_radps, a row per command.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "host/lab/guard/operator.hpp"

namespace whisker::guard {

struct Command {
  double t_s = 0;
  Twist twist;
};

/// The commands of a file or of another stream, in order of time. Throws InputError.
std::vector<Command> read_commands(std::istream& in, const std::string& name);
std::vector<Command> load_commands(const std::string& file);  ///< "-": standard input

/// Gives each command at its time, and none after the last.
class Recorded final : public Operator {
 public:
  /// At least one.
  explicit Recorded(std::vector<Command> commands);
  Twist ask(const Sight& sight) override;
  double pause_s() override;
  double first_s() override;
  /// Of the last command.
  double last_s() const { return commands_.back().t_s; }

 private:
  std::vector<Command> commands_;
  std::size_t next_ = 0;
  double now_s_ = 0;
};

}  // namespace whisker::guard
