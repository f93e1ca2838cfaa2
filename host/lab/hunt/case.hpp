/// One drive: a robot in a world, and who drives it; or random inputs of one part. A file repeats it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/harness/run/planners.hpp"
#include "host/harness/scenario/scenario.hpp"
#include "host/lab/guard/recorded.hpp"

namespace whisker::hunt {

struct Case {
  Scenario scenario;
  std::optional<PlannerKind> planner;    ///< none: the guard, under commands
  std::vector<guard::Command> commands;  ///< of the guard; empty: an Attacker with the seed `attacker`
  std::uint64_t attacker = 0;
  std::string part;        ///< of the core, judged alone with the seed `attacker` instead of a drive
  std::uint64_t gaps = 0;  ///< seed of uneven gaps between ticks; 0: each is the control period
};

/// The rows of such a file; none if it has only its header.
std::vector<guard::Command> parse_commands(const std::string& csv);
std::string commands_csv(const std::vector<guard::Command>& commands);

/// "part", "guard", or the name of the planner.
std::string driver(const Case& c);

/// The whisker command that repeats a case of this name in the current folder.
std::string repeat_command(const Case& c, const std::string& name);
/// NAME.toml, whose first line is that command and whose second says who drives, and NAME.csv with the
/// commands of the guard; `path` is without the ending.
void save(const Case& c, const std::string& path);
/// `path` with or without the ending .toml. Throws InputError.
Case load_case(const std::string& path);

/// The two files as texts, and back.
struct Texts {
  std::string toml, csv;
};
Texts texts(const Case& c, const std::string& name);
Case parse_case(const Texts& texts, const std::string& name);

}  // namespace whisker::hunt
