#include "host/cli/options.hpp"

#include <charconv>
#include <cmath>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "host/scenario/text.hpp"

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

CLI::Validator amount(double most) {
  return CLI::Validator(
      [most](std::string& text) -> std::string {
        double value = 0;
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, value);
        if (error != std::errc{} || rest != end || std::signbit(value) || !(value <= most)) {
          return fmt::format("'{}' is no number from 0 to {}", text, most);
        }
        return {};
      },
      "");
}

CLI::Option* add_wheel_scale_sigma(CLI::App& app, std::optional<double>& sigma, const std::string& help) {
  return app.add_option("--wheel-scale-sigma", sigma, help)->transform(amount(1))->type_name("S");
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

std::vector<std::string_view> planner_names() {
  std::vector<std::string_view> names;
  for (const PlannerKind kind : kPlanners) names.emplace_back(name(kind));
  return names;
}

}  // namespace

CLI::Option* add_planner(CLI::App& app, PlannerKind& kind) {
  std::string names, baselines;
  for (const PlannerKind k : kPlanners) {
    if (map_bytes(k) != 0 && k != PlannerKind::map) continue;
    std::string& list = is_baseline(k) ? baselines : names;
    list += fmt::format("{}{}{}", list.empty() ? "" : ", ", name(k),
                        k == PlannerKind::skirt ? " (or boundary)" : "");
  }
  CLI::Option* const option =
      app.add_option_function<std::string>(
             "--planner",
             [&kind](const std::string& text) {
               const auto named = planner_named(text);
               if (!named) {
                 throw CLI::ValidationError("--planner", fmt::format("no planner '{}'{}", text,
                                                                     did_you_mean(text, planner_names())));
               }
               kind = *named;
             },
             fmt::format("Planner: {};\nbaselines: {}", names, baselines))
          ->default_str(name(kind))
          ->type_name("NAME");
  // After --planner: CLI11 calls back in the order in which options were added.
  app.add_option_function<std::string>(
         "--map-bytes",
         [&kind](const std::string& text) {
           if (map_bytes(kind) == 0) {
             throw CLI::ValidationError("--map-bytes", fmt::format("planner {} has no map", name(kind)));
           }
           for (const PlannerKind k : kPlanners) {
             if (map_bytes(k) == 0 || text != fmt::format("{}", map_bytes(k))) continue;
             kind = k;
             return;
           }
           throw CLI::ValidationError("--map-bytes", fmt::format("no map of '{}' bytes", text));
         },
         "Of planner map: 1024, 2048, 4096, 8192 or 16384")
      ->default_str("2048")
      ->type_name("N");
  return option;
}

CLI::Option* add_switch(CLI::App& app, const std::string& name, bool& on, const std::string& help) {
  return app.add_flag(name, on, help)->disable_flag_override();
}

}  // namespace whisker::cli
