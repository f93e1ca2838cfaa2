#include "host/lab/campaign/failures.hpp"

#include <fmt/format.h>

#include "host/lab/campaign/worlds.hpp"
#include "host/lab/report/result.hpp"

namespace whisker::campaign {
namespace {

/// Quotes the text as one word of a POSIX shell.
std::string shell_word(const std::string& text) {
  constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./:=@%+,-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// The name of the file or the kind of world, and the seed.
std::string stem(const Row& row) {
  const std::size_t folder = row.world.rfind('/');
  const std::string last = folder == std::string::npos ? row.world : row.world.substr(folder + 1);
  const std::string world = last.substr(0, last.find(is_scenario_file(row.world) ? ".toml" : " "));
  return fmt::format("{}-{}", world, row.seed);
}

bool off_goal(const Row& row) { return row.verdict == Verdict::off_goal; }

std::string line_of(const Row& row) {
  const std::string why = off_goal(row) ? fmt::format("{:.2f} m off", row.final_distance_m) : row.detail;
  return fmt::format("seed {} {} ({}): {}\n", row.seed, report::outcome(row.verdict), why,
                     replay_command(row));
}

}  // namespace

std::string replay_command(const Row& row) {
  std::string command = is_scenario_file(row.world)
                            ? fmt::format("whisker run {} --seed {}", shell_word(row.world), row.seed)
                            : fmt::format("whisker campaign {} --replay {}", row.world, row.seed);
  command += " --planner " + shell_word(row.planner);
  if (!row.robot.empty() && !has_random_robots(row.world)) command += " --robot " + shell_word(row.robot);
  return command + " --svg " + shell_word(stem(row) + ".svg");
}

bool is_failure(const Row& row) { return !succeeded(row) || off_goal(row); }

std::string scenario_file(const Row& row) { return stem(row) + ".toml"; }

std::string failure_lines(const std::vector<Row>& rows, std::size_t most) {
  std::string lines, counts;
  std::size_t shown = 0;
  const auto add = [&](const char* what, bool (*is_one)(const Row&)) {
    std::size_t more = 0;
    for (const Row& row : rows) {
      if (!is_one(row)) continue;
      if (shown < most) {
        lines += line_of(row);
        ++shown;
      } else {
        ++more;
      }
    }
    if (more > 0) counts += fmt::format("and {} more that {}\n", more, what);
  };
  add("failed", [](const Row& row) { return !succeeded(row); });
  add("are not where they believe to be", [](const Row& row) { return succeeded(row) && off_goal(row); });
  return lines + counts;
}

}  // namespace whisker::campaign
