#include "firmware/perception/approach_watch.hpp"

#include "firmware/math/trig.hpp"
#include "firmware/params/reach.hpp"

namespace whisker::perception {
namespace {

constexpr Length kCompared = 20_mm;  // of way: longer than noise

}  // namespace

void ApproachWatch::configure(const Params& params, const Mount& front, const Mount& own) noexcept {
  const uint32_t sees_to = magnitude(own.axis - front.axis) + own.half_cone.raw();
  const bool sees_more = sees_to > front.half_cone.raw() + params.rangefinders.incidence.raw();
  stops_ = loses_walls(params.rangefinders) && sees_more ? shortest_warning(params) : Length{};
  const Length ahead =
      min(along(own.apex, own.axis - own.half_cone), along(own.apex, own.axis + own.half_cone));
  touches_ = params.body.radius + guard_slack(params) - ahead;
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
