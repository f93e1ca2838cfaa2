#include "host/cli/rules_search_output.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/cli/paired_drives.hpp"

namespace whisker::cli {
namespace {

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

}  // namespace

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

}  // namespace whisker::cli
