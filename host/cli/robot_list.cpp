#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/provenance.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/mounting.hpp"
#include "host/harness/scenario/sensor_text.hpp"
#include "host/harness/scenario/text.hpp"

namespace whisker::cli {
namespace {

namespace fs = std::filesystem;

struct ListOptions {
  std::string folder;  ///< empty: the robots that come with the command
  bool json = false;
};

struct Listed {
  std::string name;  ///< within the folder, without ".toml"
  std::string about;
  std::string sensor;
  int counts_per_m = 0;
  std::string refused;  ///< why its parameters do not fit together; empty: they do
};

/// Installed beside the command, or in the sources of which it is built.
fs::path usual_folder() {
  std::error_code error;
  const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* const there : {"../share/whisker/robots", "../../host/robots"}) {
    const fs::path folder = (here / there).lexically_normal();
    if (fs::is_directory(folder, error)) return folder;
  }
  throw UsageError("the robots that come with the command are not there: name a folder");
}

/// The first sentence of the comment that a file begins with.
std::string first_words(const std::string& text) {
  std::string words;
  std::size_t at = 0;
  while (at < text.size() && text[at] == '#') {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    words += (words.empty() ? "" : " ") + text.substr(std::min(at + 2, end), end - std::min(at + 2, end));
    at = end + 1;
  }
  const std::size_t stop = words.find(". ");
  words = words.substr(0, stop);
  if (stop == std::string::npos && !words.empty() && words.back() == '.') words.pop_back();
  return words;
}

std::string sensor_words(const Sensor& sensor) {
  if (!sensor.model.empty()) return std::string(sensor.model);
  return sensor_toml(sensor).empty() ? "ideal" : "its own";
}

Listed listed(const fs::path& folder, const fs::path& file) {
  Listed robot;
  robot.name = fs::path(file).replace_extension().lexically_relative(folder).string();
  robot.about = first_words(read_file(file.string()));
  Params params;
  Sensor sensor;
  try {
    apply_robot_file(params, sensor, file.string());
    const std::vector<std::string> against = contradictions(params, sensor);
    if (!against.empty()) robot.refused = against.front();
  } catch (const InputErrors& errors) {
    robot.refused = errors.all().front().what();
  }
  robot.sensor = sensor_words(sensor);
  robot.counts_per_m = params.wheels.counts_per_metre;
  return robot;
}

std::vector<Listed> robots_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(folder, error)) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  if (error || files.empty()) throw UsageError(fmt::format("{}: no robot files (*.toml)", folder.string()));
  std::sort(files.begin(), files.end());
  std::vector<Listed> all;
  for (const fs::path& file : files) all.push_back(listed(folder, file));
  return all;
}

void print_json(const std::vector<Listed>& robots, const fs::path& folder) {
  auto all = nlohmann::ordered_json::array();
  for (const Listed& r : robots) {
    nlohmann::ordered_json one = {{"name", r.name}, {"about", r.about}, {"sensor", r.sensor}};
    if (r.refused.empty()) one["encoder_counts_per_m"] = r.counts_per_m;
    one["fits"] = r.refused.empty();
    one["refused"] = r.refused.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(r.refused);
    all.push_back(one);
  }
  const nlohmann::ordered_json json = {{"folder", folder.string()}, {"robots", all}};
  print_object(json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_words(const std::vector<Listed>& robots, const fs::path& folder) {
  std::size_t wide = 0;
  for (const Listed& r : robots) wide = std::max(wide, r.name.size());
  for (const Listed& r : robots) {
    if (!r.refused.empty()) {
      fmt::print("{:{}}  refused: {}\n", r.name, wide, r.refused);
    } else {
      fmt::print("{:{}}  {:<8}  {:>6} counts/m  fits  {}\n", r.name, wide, r.sensor, r.counts_per_m, r.about);
    }
  }
  fmt::print("{} robots in {}; `whisker robot check` drives one\n", robots.size(), folder.string());
}

int execute(const ListOptions& o) {
  const fs::path folder = o.folder.empty() ? usual_folder() : fs::path(o.folder);
  const std::vector<Listed> robots = robots_in(folder);
  o.json ? print_json(robots, folder) : print_words(robots, folder);
  return 0;
}

}  // namespace

void add_robot_list(CLI::App& robot, int& status) {
  CLI::App* cmd = robot.add_subcommand("list", "List the robots of a folder, and whether their values fit");
  const auto o = std::make_shared<ListOptions>();
  add_name(*cmd, "DIR", o->folder, "Folder of robot files; by default those that come with the command")
      ->type_name("");
  add_switch(*cmd, "--json", o->json, "Print the list as one JSON object and nothing else");
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
