#include "host/lab/guard/recorded.hpp"

#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <utility>

#include "host/harness/scenario/csv.hpp"
#include "host/harness/scenario/error.hpp"

namespace whisker::guard {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<Command> read_commands(std::istream& in, const std::string& name) {
  CsvReader csv(in, name);
  const std::size_t t_s = csv.need("t_s"), v_mps = csv.need("v_mps"), omega_radps = csv.need("omega_radps");
  std::vector<Command> commands;
  while (csv.next()) {
    const Command c{csv.number(t_s), {csv.number(v_mps), csv.number(omega_radps)}};
    if (c.t_s < 0) csv.fail(t_s, "t_s must not be negative");
    if (!commands.empty() && c.t_s < commands.back().t_s)
      csv.fail(t_s, "t_s must not be less than in the row before");
    commands.push_back(c);
  }
  if (commands.empty()) throw InputError(name, 1, 1, "no commands");
  return commands;
}

std::vector<Command> load_commands(const std::string& file) {
  if (file == "-") return read_commands(std::cin, "standard input");
  std::ifstream in(file);
  if (!in) throw InputError(file, 1, 1, "cannot be read");
  return read_commands(in, file);
}

Recorded::Recorded(std::vector<Command> commands) : commands_(std::move(commands)) {}

Twist Recorded::ask(const Sight& sight) {
  now_s_ = sight.t_s;
  while (next_ < commands_.size() && commands_[next_].t_s <= now_s_) ++next_;
  return next_ == 0 ? Twist{} : commands_[next_ - 1].twist;
}

double Recorded::pause_s() { return next_ < commands_.size() ? commands_[next_].t_s - now_s_ : kNever; }

double Recorded::first_s() { return commands_.empty() ? kNever : commands_.front().t_s; }

}  // namespace whisker::guard
