#include "host/harness/run/planners.hpp"

#include <algorithm>

#include "firmware/fuzzy/digest.hpp"
#include "host/harness/run/core_pilot.hpp"

namespace whisker {
namespace {

using Made = std::shared_ptr<planning::Planner>;

std::vector<Baseline>& added() {
  static std::vector<Baseline> all;
  return all;
}

struct Entry {
  PlannerKind kind;
  std::string name;
  std::string_view alias;
  Made (*make)(const Params& params) = nullptr;  ///< for a baseline
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> list;
    planning::for_each_planner([&](const planning::PlannerInfo& info, auto type) {
      const bool usual = type.kMapBytes == 0 || type.kMapBytes == planning::kUsualMapBytes;
      const std::string size = usual ? "" : "-" + std::to_string(type.kMapBytes);
      const char* const alias = info.alias == nullptr ? "" : info.alias;
      list.push_back({{info.number, type.kMapBytes}, info.name + size, alias});
    });
    int number = list.back().kind.number;
    for (const Baseline& b : added()) list.push_back({{++number}, b.name, "", b.make});
    return list;
  }();
  return all;
}

const Entry& entry(PlannerKind kind) {
  const auto& all = entries();
  return *std::find_if(all.begin(), all.end(), [&](const Entry& e) { return e.kind == kind; });
}

}  // namespace

void add_baselines(const Baseline* baselines, std::size_t count) {
  added().insert(added().end(), baselines, baselines + count);
}

RecordedPlanner make_recorded_planner(PlannerKind kind, const Params& params) {
  if (is_baseline(kind)) return {entry(kind).make(params)};
  return make_core_planner(kind, params, *kind.table);
}

std::shared_ptr<planning::Planner> make_planner(PlannerKind kind, const Params& params) {
  return make_recorded_planner(kind, params).planner;
}

std::vector<PlannerKind> planners() {
  std::vector<PlannerKind> kinds;
  for (const Entry& e : entries()) kinds.push_back(e.kind);
  return kinds;
}

bool is_baseline(PlannerKind kind) { return entry(kind).make != nullptr; }
const std::string& name(PlannerKind kind) { return entry(kind).name; }
std::uint32_t rules_digest(PlannerKind kind) { return is_baseline(kind) ? 0 : fuzzy::digest(*kind.table); }
std::string_view alias(PlannerKind kind) { return entry(kind).alias; }

std::optional<PlannerKind> planner_named(std::string_view text) {
  for (const Entry& e : entries()) {
    if (text == e.name || (!e.alias.empty() && text == e.alias)) return e.kind;
  }
  return std::nullopt;
}

}  // namespace whisker
