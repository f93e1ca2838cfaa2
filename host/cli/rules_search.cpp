#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/exit_status.hpp"
#include "host/cli/options.hpp"
#include "host/cli/output.hpp"
#include "host/cli/provenance.hpp"
#include "host/cli/rules_choice.hpp"
#include "host/cli/table_search.hpp"
#include "host/harness/file/file.hpp"

namespace whisker::cli {
namespace {

struct SearchNames {
  std::string base;                 ///< a file, or "default"
  std::vector<std::string> worlds;  ///< of the plan's classes: "discs --discs 75 --box"
  std::string drives;               ///< "planner map", or "sloppy operator with assist"
};

using Json = nlohmann::ordered_json;

std::uint64_t first_of_validation(const SearchPlan& plan) { return plan.first_seed + plan.searched(); }
std::uint64_t last_of_validation(const SearchPlan& plan) {
  return first_of_validation(plan) + plan.validation - 1;
}

std::string digest_text(const Candidate& c) { return fmt::format("{:08x}", c.digest); }

const char* verdict_text(const Validation& v) {
  return v.better ? "better: no more contacts, no fewer successes, and the bounds of the time are below 1"
                  : "not better";
}

Json validation_json(const SearchPlan& plan, const SearchNames& names, const Validation& v) {
  Json classes = Json::array();
  for (std::size_t k = 0; k < v.classes.size(); ++k) {
    Json one = {{"world", names.worlds[k]}};
    one.update(comparison_json(v.classes[k]));
    classes.push_back(one);
  }
  return {{"first_seed", first_of_validation(plan)},
          {"last_seed", last_of_validation(plan)},
          {"classes", classes},
          {"all", comparison_json(v.all)},
          {"time_ratio_with_failures", estimate_json(v.time)},
          {"better", v.better}};
}

void print_generation(std::FILE* out, const Generation& g) {
  fmt::print(out, "generation {}: {:08x}, time over its parent {}, {}\n", g.number, g.digest,
             estimate_text(g.time, 3), g.kept ? "kept" : "dropped");
  std::fflush(out);
}

void print_validation(std::FILE* out, const SearchPlan& plan, const SearchNames& names, const Validation& v) {
  fmt::print(out, "validation: A = {}, B = the rules found, {}, seeds {} to {} of each class\n", names.base,
             names.drives, first_of_validation(plan), last_of_validation(plan));
  for (std::size_t k = 0; k < v.classes.size(); ++k) {
    fmt::print(out, "{}, {} worlds\n", names.worlds[k], v.classes[k].worlds);
    print_comparison(out, v.classes[k]);
  }
  if (v.classes.size() > 1) {
    fmt::print(out, "all classes, {} worlds\n", v.all.worlds);
    print_comparison(out, v.all);
  }
  fmt::print(out, "time with failures, B / A: {}; {}\n", estimate_text(v.time, 3), verdict_text(v));
}

/// The best rules as a file; its first lines say how they were found.
std::string searched_file(const SearchPlan& plan, const SearchNames& names, const TableSearch& search,
                          const std::optional<Validation>& v) {
  std::string comment = fmt::format(
      "Found by whisker rules search, {}, in {}: seeds {} to {},\n{} of {} generations of {} children.\n",
      names.drives, fmt::join(names.worlds, ", "), plan.first_seed, first_of_validation(plan) - 1,
      search.generations().size(), plan.generations, plan.children);
  comment += fmt::format("It started from the table {}; this is {}.\n", digest_text(search.base()),
                         digest_text(search.best()));
  comment += v ? fmt::format("Seeds {} to {}: time {} of the first table's, with 95 % bounds;\n{}.",
                             first_of_validation(plan), last_of_validation(plan), estimate_text(v->time, 3),
                             verdict_text(*v))
               : "Not validated.";
  return rules::to_toml(search.best().rules, "searched", comment);
}

/// One object, without provenance. No validation: no child was kept.
std::string search_json(const SearchPlan& plan, const SearchNames& names, const TableSearch& search,
                        const std::optional<Validation>& v) {
  Json generations = Json::array();
  for (const Generation& g : search.generations())
    generations.push_back({{"rules_digest", fmt::format("{:08x}", g.digest)},
                           {"time_ratio", estimate_json(g.time)},
                           {"kept", g.kept}});
  const Json json = {{"base", names.base},
                     {"base_digest", digest_text(search.base())},
                     {"assist", plan.assist},
                     {"children", plan.children},
                     {"first_seed", plan.first_seed},
                     {"last_seed", first_of_validation(plan) - 1},
                     {"generations", generations},
                     {"validation", v ? validation_json(plan, names, *v) : Json(nullptr)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

constexpr std::uint64_t kMostGenerations = 10000;
constexpr std::uint64_t kMostChildren = 256;
constexpr std::uint64_t kMostWorlds = 100000;

struct SearchOptions {
  std::string base = "default";
  std::string out;
  std::string kinds;
  std::uint64_t seed = 1;
  SearchPlan plan;
  CampaignOptions campaign;
};

worlds::Kind kind_of(std::string_view word) {
  if (const auto kind = worlds::kind_named(word)) return *kind;
  std::vector<std::string_view> known;
  for (const worlds::Kind kind : worlds::kAllKinds) known.emplace_back(name(kind));
  throw UsageError(fmt::format("--worlds: no kind of world '{}'{}", word, did_you_mean(word, known)));
}

/// "discs,rooms"
std::vector<worlds::Kind> kinds(const SearchOptions& o) {
  std::vector<worlds::Kind> all;
  for (std::size_t from = 0; from <= o.kinds.size();) {
    const std::size_t end = std::min(o.kinds.find(',', from), o.kinds.size());
    const worlds::Kind kind = kind_of(std::string_view(o.kinds).substr(from, end - from));
    if (std::find(all.begin(), all.end(), kind) != all.end())
      throw UsageError(fmt::format("--worlds: '{}' is given twice", name(kind)));
    if (o.plan.assist && worlds::has_no_way(kind))
      throw UsageError(fmt::format("--assist: no path for the operator in {}", name(kind)));
    all.push_back(kind);
    from = end + 1;
  }
  return all;
}

void check(const SearchOptions& o) {
  const struct {
    const char* option;
    std::uint64_t value;
  } counts[] = {{"--count", o.plan.count},
                {"--generations", o.plan.generations},
                {"--children", o.plan.children},
                {"--validate", o.plan.validation}};
  for (const auto& one : counts)
    if (one.value == 0) throw UsageError(fmt::format("{} 0: nothing to do", one.option));
  if (!o.plan.assist && is_baseline(o.campaign.planner))
    throw UsageError(fmt::format("rules search: planner {} has no table", name(o.campaign.planner)));
}

SearchPlan plan_of(const SearchOptions& o) {
  SearchPlan plan = o.plan;
  plan.first_seed = o.seed;
  plan.jobs = o.campaign.jobs;
  for (const worlds::Kind kind : kinds(o)) {
    CampaignOptions one = o.campaign;
    one.worlds = name(kind);
    one.seed = o.seed;
    one.count = plan.searched() + plan.validation;
    plan.classes.push_back(missions(one));
  }
  return plan;
}

SearchNames names_of(const SearchOptions& o) {
  SearchNames names{
      o.base, {}, o.plan.assist ? "sloppy operator with assist" : "planner " + name(o.campaign.planner)};
  for (const worlds::Kind kind : kinds(o))
    names.worlds.push_back(campaign::arguments(kind, o.campaign.world));
  return names;
}

Candidate base_of(const SearchOptions& o) {
  const auto base =
      candidate(o.base == "default" ? rules::core_rules() : rules::mirrored_rules(load_rules(o.base)));
  if (base) return *base;
  throw UsageError(fmt::format("{}: the look-up errs by more than {:g} % of the span", o.base,
                               100 * rules::kMostLookUpError));
}

/// Writes the best so far, if there is one.
[[noreturn]] void interrupted(const SearchOptions& o, const SearchPlan& plan, const SearchNames& names,
                              const TableSearch& search) {
  const bool found = search.best().digest != search.base().digest;
  if (found) files::write(o.out, searched_file(plan, names, search, std::nullopt));
  throw Interrupted(fmt::format(" after {} of {} generations; {}", search.generations().size(),
                                plan.generations,
                                found ? fmt::format("{}: the best rules so far", o.out) : "nothing written"));
}

int execute(const SearchOptions& o) {
  const bool from_file = o.base != "default";
  check_outputs({o.out}, {from_file ? o.base : "", o.campaign.robot}, o.campaign.json);
  check(o);
  const Interrupt noted;  // also between two rounds of missions
  const SearchPlan plan = plan_of(o);
  const SearchNames names = names_of(o);
  const Candidate base = base_of(o);
  TableSearch search(plan, base);
  std::FILE* const out = words_beside({o.out});
  const auto after = [&](const Generation& g) {
    // For a process that is killed.
    if (g.kept && o.out != "-") files::write(o.out, searched_file(plan, names, search, std::nullopt));
    if (!o.campaign.json) print_generation(out, g);
  };
  if (!search.run(after)) interrupted(o, plan, names, search);
  const bool found = search.best().digest != base.digest;
  const auto validation = found ? search.validate() : std::nullopt;
  if (found && !validation) interrupted(o, plan, names, search);
  files::write(o.out, searched_file(plan, names, search, validation));
  if (o.campaign.json) {
    Provenance p;
    p.seed = o.seed;
    if (!plan.assist) p.planner = name(o.campaign.planner);
    p.rules_digest = fmt::format("{:08x}", search.best().digest);
    print_object(search_json(plan, names, search, validation), p);
  } else {
    if (validation) print_validation(out, plan, names, *validation);
    if (!validation) fmt::print(out, "no child was kept: the rules are the base's\n");
    fmt::print(out, "rules: {}\n", o.out);
  }
  return 0;
}

constexpr const char* kFooter = R"(
rules search: each generation drives worlds of its own with the best table so far and its children;
the better half of the children goes on to more worlds. The last child becomes the best if, in the
worlds of the last round alone, it has no more contacts, no fewer successes, and less time, as far
as 95 % bounds can tell; a mission that fails counts as ten time limits. In the end, base and best
drive worlds that no generation has driven.
Exit status of rules search: 0 the file is written, better than the base or not, 130 interrupted,
2 bad input or usage, 1 anything else.)";

}  // namespace

void add_rules_search(CLI::App& rules, int& status) {
  CLI::App* cmd = rules.add_subcommand("search", "Find rules and centres that drive faster, by a hill climb");
  const auto o = std::make_shared<SearchOptions>();
  add_file(*cmd, "--base", o->base, "Rules to start from (.toml), mirrored in R; the core's own by default");
  add_name(*cmd, "--worlds", o->kinds, "Kinds of world as in `whisker world`, joined by commas")
      ->required()
      ->type_name("KIND,..");
  const auto number = [&](const char* option, std::uint64_t& value, std::uint64_t most, const char* help) {
    whole_number(cmd->add_option(option, value, fmt::format("{}; {} by default", help, value)), "N", most);
  };
  number("--count", o->plan.count, kMostWorlds, "Worlds of a kind in a generation");
  whole_number(
      cmd->add_option("--seed", o->seed, "Of the first world of each kind, and of the changes; 1 by default"),
      "S");
  number("--generations", o->plan.generations, kMostGenerations, "How many");
  number("--children", o->plan.children, kMostChildren, "Changed tables in a generation");
  number("--validate", o->plan.validation, kMostWorlds, "Worlds of a kind to validate in");
  add_switch(*cmd, "--assist", o->plan.assist,
             "Search for the guard's assist: a sloppy operator drives,\nas in `whisker operators`");
  add_world_shape(*cmd, o->campaign);
  add_switch(*cmd, "--noise", o->campaign.world.noise,
             "Sensor noise and odometry error, as in `whisker world`");
  add_planner_kind(*cmd, o->campaign.planner)->excludes("--assist");
  add_file(*cmd, "--robot", o->campaign.robot, "Parameters of your robot (TOML), over those of the worlds");
  add_jobs(*cmd, o->campaign);
  add_file(*cmd, "--out", o->out, "Write the best rules (.toml)")->required();
  add_switch(*cmd, "--json", o->campaign.json, "Print the result as one JSON object and nothing else");
  cmd->footer(kFooter);
  cmd->callback([o, &status] { status = execute(*o); });
}

}  // namespace whisker::cli
