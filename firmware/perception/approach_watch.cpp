#include "firmware/perception/approach_watch.hpp"

#include "firmware/math/trig.hpp"
#include "firmware/params/reach.hpp"
#include "hal/types.hpp"

namespace whisker::perception {
namespace {

constexpr Length kCompared = 20_mm;  // of way: longer than noise

}  // namespace

void ApproachWatch::configure(const Params& params, int beam) noexcept {
  const RangefinderParams& sensors = params.rangefinders;
  const Mount front = mount(sensors, hal::kFront);
  const Mount own = mount(sensors, beam);
  const int64_t aside = magnitude(own.axis - front.axis);
  const bool sees_more =
      aside + own.half_cone.raw() > int64_t{front.half_cone.raw()} + sensors.incidence.raw();
  const bool watched = loses_walls(sensors) && beam != hal::kFront && sees_more;
  const Length ahead =
      min(along(own.apex, own.axis - own.half_cone), along(own.apex, own.axis + own.half_cone));
  touches_ = params.body.radius + guard_slack(params) - ahead;
  stops_ = watched ? shortest_warning(params) : Length{};
  reset();
}

bool ApproachWatch::ends_at_body(const ConeObservation& echo) noexcept {
  if (stops_ == Length{}) return false;
  const Length way = norm(echo.beam.apex - from_);
  if (!any_ || way > kCompared) {
    // The share of the way by which it has come nearer, of the way in which the body stops.
    const bool compares = any_ && way <= kCompared * 4;
    nearer_ = compares ? Length::from_raw(multiply_divide((free_ - echo.free).raw(), stops_.raw(), way.raw()))
                       : Length{};
    from_ = echo.beam.apex;
    free_ = echo.free;
    any_ = true;
  }
  return nearer_ > Length{} && echo.free - nearer_ < touches_;
}

}  // namespace whisker::perception
