#include "host/lab/campaign/worlds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "host/harness/scenario/load.hpp"
#include "host/lab/campaign/random_robot.hpp"

namespace whisker::campaign {
namespace {

constexpr std::string_view kSuffix = ".toml";

}  // namespace

bool has_control_characters(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7F'; });
}

bool is_scenario_file(std::string_view name) {
  return name.size() > kSuffix.size() && name.substr(name.size() - kSuffix.size()) == kSuffix;
}

std::string arguments(worlds::Kind kind, const worlds::Options& o) {
  std::string text = worlds::name(kind);
  if (o.discs) text += fmt::format(" --discs {}", *o.discs);
  if (o.gap_m) text += fmt::format(" --width {}", *o.gap_m);
  if (o.box) text += " --box";
  if (o.noise) text += " --noise";
  if (o.wheel_scale_sigma) text += fmt::format(" --wheel-scale-sigma {}", *o.wheel_scale_sigma);
  return text;
}

bool has_random_robots(std::string_view world) {
  return !is_scenario_file(world) && world.size() > kRandomRobots.size() &&
         world.substr(world.size() - kRandomRobots.size()) == kRandomRobots;
}

std::string random_robot_name(std::uint64_t seed) { return fmt::format("random {}", seed); }

Files load_folder(const std::string& folder, const std::string& robot_file) {
  Files files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().string();
    if (is_scenario_file(name)) files.names.push_back(name);
  }
  std::sort(files.names.begin(), files.names.end());
  if (files.names.empty()) throw std::invalid_argument(fmt::format("{}: no scenario files (*.toml)", folder));
  for (const std::string& name : files.names) {
    if (has_control_characters(name)) {
      throw std::invalid_argument(fmt::format("{}: a file's name has control characters in it", folder));
    }
    files.scenarios.push_back(load_scenario(name, robot_file));
    files.scenarios.back().events.clear();
  }
  return files;
}

Mission mission(const Generated& g, std::uint64_t index) {
  worlds::Options options = g.options;
  options.seed = g.first_seed + index;
  Mission m{options.seed, arguments(g.kind, options), worlds::generate(g.kind, options)};
  if (g.random_robots) {
    m.world += kRandomRobots;
    fit_to(m.scenario, random_robot(options.seed).params);
  }
  return m;
}

Mission mission(const Files& files, std::uint64_t index) {
  const std::size_t file = static_cast<std::size_t>(index % files.names.size());
  Mission m{0, files.names[file], files.scenarios[file]};
  if (files.first_seed) m.scenario.seed = *files.first_seed + index;
  m.seed = m.scenario.seed;
  return m;
}

}  // namespace whisker::campaign
