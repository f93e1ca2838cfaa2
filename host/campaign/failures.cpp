#include "host/campaign/failures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/campaign/worlds.hpp"
#include "host/report/result.hpp"

namespace whisker::campaign {
namespace {

/// As a single word of a POSIX shell.
std::string shell_word(const std::string& text) {
  constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./:=@%+,-";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// The picture's name: that of the file, or of the kind of world.
std::string picture(const Row& row) {
  const std::size_t folder = row.world.rfind('/');
  const std::string last = folder == std::string::npos ? row.world : row.world.substr(folder + 1);
  const std::string stem = last.substr(0, last.find(is_scenario_file(row.world) ? ".toml" : " "));
  return fmt::format("{}-{}.svg", stem, row.seed);
}

}  // namespace

std::string replay_command(const Row& row) {
  std::string command = is_scenario_file(row.world)
                            ? fmt::format("whisker run {} --seed {}", shell_word(row.world), row.seed)
                            : fmt::format("whisker campaign {} --replay {}", row.world, row.seed);
  command += " --planner " + shell_word(row.planner);
  if (!row.robot.empty()) command += " --robot " + shell_word(row.robot);
  return command + " --svg " + shell_word(picture(row));
}

std::string failure_lines(const std::vector<Row>& rows, std::size_t most) {
  const auto failed = static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const Row& r) { return !succeeded(r); }));
  std::string text;
  std::size_t shown = 0;
  for (const Row& row : rows) {
    if (shown == most) break;
    if (succeeded(row)) continue;
    text += fmt::format("seed {} {} ({}): {}\n", row.seed, report::outcome(row.verdict), row.detail,
                        replay_command(row));
    ++shown;
  }
  if (failed > shown) text += fmt::format("and {} more that failed\n", failed - shown);
  return text;
}

}  // namespace whisker::campaign
