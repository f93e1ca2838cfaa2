/// The thesis's response table as deflection law of the boundary planner.
#pragma once

#include "firmware/fuzzy/engine.hpp"
#include "firmware/planning/boundary/boundary_planner.hpp"
#include "firmware/planning/boundary/course.hpp"

namespace whisker::planning {

/// One look-up of the response table: SA bends the course by some degrees per unit, if BoundaryParams::bend
/// asks for it, and SD sets the pace where clear ground is in doubt.
class TableDeflection final : public HeadingDeflection {
 public:
  explicit TableDeflection(const fuzzy::Engine::Table& table) noexcept : engine_(table) {}
  Angle deflect(const View& view, Angle course, const Params& params, Decision& decision) noexcept override;

 private:
  fuzzy::Engine engine_;
};

/// The boundary planner with its standard law.
struct TableBoundaryPlanner {
  /// Both references must outlive it.
  TableBoundaryPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept
      : law(table), planner(params, law) {}
  TableDeflection law;
  BoundaryPlanner planner;
};

}  // namespace whisker::planning
