#include "host/cli/options.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "host/cli/exit_status.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/harness/scenario/text.hpp"

namespace whisker::cli {

CLI::Validator whole_number(std::uint64_t most) {
  return CLI::Validator(
      [most](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc{} || rest != end || value > most) {
          return fmt::format("'{}' is no whole number from 0 to {}", text, most);
        }
        // CLI11 would read leading zeros as octal.
        text = fmt::format("{}", value);
        return {};
      },
      "");
}

namespace {

CLI::Validator between(double low, double high) {
  return CLI::Validator(
      [low, high](std::string& text) -> std::string {
        double value = 0;
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, value);
        const bool inside = value >= low && value <= high && !(low >= 0 && std::signbit(value));
        if (error == std::errc{} && rest == end && inside) return {};
        return fmt::format("'{}' is no number from {} to {}", text, low, high);
      },
      "");
}

}  // namespace

CLI::Validator amount(double most) { return between(0, most); }

CLI::Option* whole_number(CLI::Option* option, const char* type, std::uint64_t most) {
  return option->transform(whole_number(most))->type_name(type);
}

CLI::Option* how_many(CLI::Option* option, const char* type, std::uint64_t most) {
  const std::string name = option->get_name();
  return whole_number(option, type, most)->check([name](const std::string& text) {
    if (text == "0") throw UsageError(name + " 0: nothing to do");
    return std::string();
  });
}

CLI::Option* amount(CLI::Option* option, const char* type, double most) {
  return option->transform(amount(most))->type_name(type);
}

CLI::Option* within(CLI::Option* option, const char* type, int low, int high) {
  return option->check(CLI::Range(low, high))->type_name(type);
}

CLI::Option* within(CLI::Option* option, const char* type, double low, double high) {
  return option->check(between(low, high))->type_name(type);
}

CLI::Option* add_wheel_scale_sigma(CLI::App& app, std::optional<double>& sigma, const std::string& help) {
  return amount(app.add_option("--wheel-scale-sigma", sigma, help), "S", 1);
}

CLI::Option* add_gap_width(CLI::App& app, std::optional<double>& width, const std::string& help) {
  return amount(app.add_option("--width", width, help), "W", 1);
}

CLI::Option* add_name(CLI::App& app, const std::string& option, std::string& name, const std::string& help) {
  const auto not_empty = [](const std::string& text) { return std::string(text.empty() ? "no name" : ""); };
  return app.add_option(option, name, help)->check(not_empty);
}

CLI::Option* add_file(CLI::App& app, const std::string& name, std::string& path, const std::string& help) {
  return add_name(app, name, path, help)->type_name("FILE");
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& known) {
  const std::string_view near = nearest_word(word, known);
  return near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
}

namespace {

PlannerKind planner_of(const std::string& text) {
  if (const auto named = planner_named(text)) return *named;
  std::vector<std::string_view> names;
  for (const PlannerKind kind : planners()) {
    names.emplace_back(name(kind));
    if (!alias(kind).empty()) names.push_back(alias(kind));
  }
  throw CLI::ValidationError("--planner", fmt::format("no planner '{}'{}", text, did_you_mean(text, names)));
}

PlannerKind with_map_of(PlannerKind kind, const std::string& bytes) {
  if (kind.map_bytes == 0) {
    throw CLI::ValidationError("--map-bytes", fmt::format("planner {} has no map", name(kind)));
  }
  for (const PlannerKind k : planners()) {
    if (k.number == kind.number && bytes == fmt::format("{}", k.map_bytes)) return k;
  }
  throw CLI::ValidationError("--map-bytes", fmt::format("no map of '{}' bytes", bytes));
}

}  // namespace

CLI::Option* add_planner_kind(CLI::App& app, PlannerKind& kind) {
  std::string names, baselines;
  for (const PlannerKind k : planners()) {
    if (k.map_bytes != 0 && k.map_bytes != planning::kUsualMapBytes) continue;
    std::string& list = is_baseline(k) ? baselines : names;
    list += (list.empty() ? "" : ", ") + name(k);
    if (!alias(k).empty()) list += fmt::format(" (or {})", alias(k));
  }
  std::vector<std::int32_t> sizes;
  for (const planning::MapSize& size : planning::kMapSizes) sizes.push_back(size.bytes);
  CLI::Option* const option =
      app.add_option_function<std::string>(
             "--planner", [&kind](const std::string& text) { kind = planner_of(text); },
             fmt::format("Planner: {};\nbaselines: {}", names, baselines))
          ->default_str(name(kind))
          ->type_name("NAME");
  // After --planner: CLI11 calls back in the order in which options were added.
  app.add_option_function<std::string>(
         "--map-bytes", [&kind](const std::string& text) { kind = with_map_of(kind, text); },
         fmt::format("Of planner map: {}", fmt::join(sizes, ", ")))
      ->default_str(fmt::format("{}", planning::kUsualMapBytes))
      ->type_name("N");
  return option;
}

CLI::Option* add_planner(CLI::App& app, PlannerKind& kind) {
  CLI::Option* const option = add_planner_kind(app, kind);
  add_rules_choice(app, kind,
                   "Response table from a rule base (.fis, .fll, .fcl, .toml) with\n"
                   "inputs D and R, outputs SA and SD; sets bend_course,\n"
                   "unless a bus or a log gives the robot's parameters");
  return option;
}

CLI::Option* add_switch(CLI::App& app, const std::string& name, bool& on, const std::string& help) {
  return app.add_flag(name, on, help)->disable_flag_override();
}

}  // namespace whisker::cli
