#include "host/lab/hunt/case.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <sstream>

#include "host/harness/file/file.hpp"
#include "host/harness/scenario/error.hpp"
#include "host/harness/scenario/load.hpp"
#include "host/harness/scenario/write.hpp"

namespace whisker::hunt {
namespace {

constexpr std::string_view kToml = ".toml";
constexpr const char* kHeader = "t_s,v_mps,omega_radps\n";

std::string base_name(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

std::string without_ending(const std::string& path) {
  const bool ends = path.size() > kToml.size() && path.substr(path.size() - kToml.size()) == kToml;
  return ends ? path.substr(0, path.size() - kToml.size()) : path;
}

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path, 1, 1, "cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The word after this one in the file's second line; empty: none.
std::string option(const std::string& toml, const std::string& name) {
  std::istringstream lines(toml);
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  std::istringstream words(line);
  std::string word, value;
  while (words >> word) {
    if (word == name) words >> value;
  }
  return value;
}

std::uint64_t number(const std::string& text) {
  std::uint64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::vector<guard::Command> parse_commands(const std::string& csv) {
  if (csv == kHeader) return {};
  std::istringstream rows(csv);
  return guard::read_commands(rows, "commands");
}

std::string commands_csv(const std::vector<guard::Command>& commands) {
  std::string text = kHeader;
  for (const guard::Command& c : commands) {
    text += fmt::format("{},{},{}\n", c.t_s, c.twist.forward_mps, c.twist.turning_radps);
  }
  return text;
}

std::string driver(const Case& c) {
  return !c.part.empty() ? "part" : c.planner ? name(*c.planner) : "guard";
}

std::string repeat_command(const Case& c, const std::string& name) {
  const bool only_here = c.gaps != 0 || (!c.planner && c.commands.empty());
  if (only_here) return fmt::format("whisker hunt --case {}.toml", name);
  if (c.planner) return fmt::format("whisker run {}.toml --planner {}", name, whisker::name(*c.planner));
  return fmt::format("whisker guard {0}.toml --commands {0}.csv", name);
}

Texts texts(const Case& c, const std::string& name) {
  const bool recorded = !c.planner && !c.commands.empty();
  const std::string driven = !c.part.empty() ? fmt::format("part {} attacker {}", c.part, c.attacker)
                             : c.planner     ? fmt::format("planner {}", whisker::name(*c.planner))
                             : recorded      ? fmt::format("commands {}.csv", name)
                                             : fmt::format("attacker {}", c.attacker);
  return {fmt::format("# {}\n# gaps {} {}\n{}", repeat_command(c, name), c.gaps, driven, to_toml(c.scenario)),
          recorded ? commands_csv(c.commands) : ""};
}

void save(const Case& c, const std::string& path) {
  const Texts both = texts(c, base_name(path));
  files::write(path + ".toml", both.toml);
  if (!both.csv.empty()) files::write(path + ".csv", both.csv);
}

Case parse_case(const Texts& texts, const std::string& name) {
  Case c;
  c.scenario = parse_scenario(texts.toml, name + ".toml");
  c.gaps = number(option(texts.toml, "gaps"));
  c.attacker = number(option(texts.toml, "attacker"));
  c.part = option(texts.toml, "part");
  const std::string planner = option(texts.toml, "planner");
  if (!planner.empty()) c.planner = planner_named(planner);
  if (!planner.empty() && !c.planner) throw InputError(name + ".toml", 1, 1, "no such planner");
  if (!texts.csv.empty()) c.commands = parse_commands(texts.csv);
  return c;
}

Case load_case(const std::string& path) {
  const std::string name = without_ending(path);
  Texts both{content(name + ".toml"), ""};
  if (!option(both.toml, "commands").empty()) both.csv = content(name + ".csv");
  return parse_case(both, name);
}

}  // namespace whisker::hunt
