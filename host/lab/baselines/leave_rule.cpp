#include "host/lab/baselines/leave_rule.hpp"

namespace whisker::baselines {

Length seen_free(const planning::View& view, const planning::Target& target, const Params& params) {
  Length free;
  for (int i = 0; i < hal::kBeams; ++i) {
    const perception::Echo& echo = view.moving_scan.beam[i];
    if (!perception::usable(echo.validity)) continue;
    const Angle axis = view.pose.heading + beam_axis(params.rangefinders, i);
    if (magnitude(axis - target.direction()) > (6_deg).raw()) continue;
    free = max(free, echo.distance - view.local_grid->reach().planning);
  }
  return free;
}

}  // namespace whisker::baselines
