// A program that links the baselines lists them among its planners.
#include <cstddef>
#include <iterator>
#include <memory>

#include "host/harness/run/planners.hpp"
#include "host/lab/baselines/bug_planner.hpp"
#include "host/lab/baselines/deflection_laws.hpp"
#include "host/lab/baselines/leave_rules.hpp"

namespace whisker::baselines {
namespace {

/// A planner that shares the lifetime of its owner, which also holds its rule or law.
template <class Whole>
std::shared_ptr<planning::Planner> made(const Params& params) {
  const auto whole = std::make_shared<Whole>(params);
  return {whole, &whole->planner};
}

constexpr Baseline kBaselines[] = {
    {"bug2", made<RuledPlanner<Bug2>>},
    {"distbug", made<RuledPlanner<DistBug>>},
    {"wall-follower", made<RuledPlanner<WallFollower>>},
    {"fan", made<DeflectedBoundaryPlanner<NoDeflection>>},
    {"repulsion", made<DeflectedBoundaryPlanner<RepulsionDeflection>>},
};

[[maybe_unused]] const bool registered = [] {
  add_baselines(kBaselines, std::size(kBaselines));
  return true;
}();

}  // namespace
}  // namespace whisker::baselines
