#include "host/run/planners.hpp"

#include <algorithm>

#include "host/baselines/bends.hpp"
#include "host/baselines/bug2.hpp"
#include "host/baselines/distbug.hpp"
#include "host/baselines/wall_follower.hpp"
#include "host/run/core_pilot.hpp"

namespace whisker {
namespace {

using Made = std::shared_ptr<planning::Planner>;

template <class Planner>
Made made(const Params& params) {
  return std::make_shared<Planner>(params);
}

/// The planner and the law that bends its course live and die together.
template <class Bend>
Made bent_skirt(const Params& params) {
  const auto skirt = std::make_shared<baselines::DeflectedBoundaryPlanner<Bend>>(params);
  return {skirt, &skirt->planner};
}

struct Baseline {
  const char* name;
  Made (*make)(const Params& params);
};
constexpr Baseline kBaselines[] = {
    {"bug2", made<baselines::Bug2>},
    {"distbug", made<baselines::DistBug>},
    {"wall-follower", made<baselines::WallFollower>},
    {"fan", bent_skirt<baselines::NoDeflection>},
    {"repulsion", bent_skirt<baselines::RepulsionDeflection>},
};

struct Entry {
  PlannerKind kind;
  std::string name;
  std::string_view alias;
  Made (*make)(const Params& params) = nullptr;  ///< of a baseline
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
    for (const Baseline& b : kBaselines) list.push_back({{++number}, b.name, "", b.make});
    return list;
  }();
  return all;
}

const Entry& entry(PlannerKind kind) {
  const auto& all = entries();
  return *std::find_if(all.begin(), all.end(), [&](const Entry& e) { return e.kind == kind; });
}

}  // namespace

SeenPlanner make_seen_planner(PlannerKind kind, const Params& params) {
  if (is_baseline(kind)) return {entry(kind).make(params)};
  return make_core_planner(kind, params, fuzzy::kDefaultTable);
}

std::shared_ptr<planning::Planner> make_planner(PlannerKind kind, const Params& params) {
  return make_seen_planner(kind, params).planner;
}

std::vector<PlannerKind> planners() {
  std::vector<PlannerKind> kinds;
  for (const Entry& e : entries()) kinds.push_back(e.kind);
  return kinds;
}

bool is_baseline(PlannerKind kind) { return entry(kind).make != nullptr; }
const std::string& name(PlannerKind kind) { return entry(kind).name; }
std::string_view alias(PlannerKind kind) { return entry(kind).alias; }

std::optional<PlannerKind> planner_named(std::string_view text) {
  for (const Entry& e : entries()) {
    if (text == e.name || (!e.alias.empty() && text == e.alias)) return e.kind;
  }
  return std::nullopt;
}

}  // namespace whisker
