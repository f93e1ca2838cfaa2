#include "host/lab/guard/recorded.hpp"

#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <utility>

#include "host/harness/scenario/error.hpp"

namespace whisker::guard {
namespace {

constexpr const char* kHeader = "t_s,v_mps,omega_radps";
constexpr double kNever = std::numeric_limits<double>::infinity();

Command parse(const std::string& line, const std::string& name, std::size_t number) {
  std::istringstream in(line);
  in.imbue(std::locale::classic());
  Command c;
  char first = 0, second = 0;
  in >> c.t_s >> first >> c.twist.forward_mps >> second >> c.twist.turning_radps;
  std::string rest;
  if (!in || first != ',' || second != ',' || in >> rest) {
    throw InputError(name, number, 1, std::string("a row has three numbers: ") + kHeader);
  }
  if (c.t_s < 0) throw InputError(name, number, 1, "t_s must not be negative");
  return c;
}

}  // namespace

std::vector<Command> read_commands(std::istream& in, const std::string& name) {
  std::vector<Command> commands;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      if (line != kHeader) throw InputError(name, 1, 1, std::string("the first line must be ") + kHeader);
      continue;
    }
    commands.push_back(parse(line, name, number));
    if (commands.size() > 1 && commands.back().t_s < commands[commands.size() - 2].t_s) {
      throw InputError(name, number, 1, "t_s must not be less than in the row before");
    }
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
