#include "firmware/safety/assist.hpp"

#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/scale.hpp"
#include "firmware/planning/steering.hpp"

namespace whisker::safety {
namespace {

constexpr Angle kAside[] = {30_deg, 60_deg};

/// How far the disc of radius `wide` goes straight along `heading` until it meets a suspect cell.
Length room(const perception::LocalGrid& grid, const Pose& pose, Angle heading, Length length,
            Length wide) noexcept {
  Length room = length;
  const auto meet = [&](const Vec& cell) {
    const int64_t beside = across(cell, heading).raw(), r = wide.raw();
    const int64_t rest = r * r - beside * beside;
    const Length before =
        Length::from_raw(rest > 0 ? saturate32(square_root(static_cast<uint64_t>(rest))) : 0);
    room = min(room, max(Length{}, along(cell, heading) - before));
  };
  grid.each_unclear(pose.at, heading, length, wide, meet, perception::Avoid::suspect);
  return room;
}

}  // namespace

Assist::Assist() noexcept : table_(&fuzzy::kResponseTable) {}

planning::VelocityRequest Assist::step(const planning::VelocityRequest& asked, Speed fastest,
                                       const Pose& pose, const perception::LocalGrid& grid,
                                       const Params& params) noexcept {
  active_ = false;
  if (!asked.moves || asked.forward <= Speed{}) return asked;
  const Length length = params.body.radius * 2;
  // Cells are met by their centres here, and by their corners in the guard.
  const Length wide = grid.reach().planning + cell_cover(params);
  const Length ahead = room(grid, pose, pose.heading, length, wide);
  Length left, right;
  for (const Angle aside : kAside) {
    left = max(left, room(grid, pose, pose.heading + aside, length, wide));
    right = max(right, room(grid, pose, pose.heading - aside, length, wide));
  }
  const fuzzy::Response response = fuzzy::Bilinear(*table_)(fuzzy::scale(left, ahead, right, length));

  planning::VelocityRequest bent = asked;
  constexpr Q14 kAll = Q14::ratio(1, 1);
  if (response.step < kAll) bent.forward = max(Speed{}, asked.forward * response.step);
  const Speed most = min(fastest, planning::kFastestTurn * (params.body.track / 2));
  const Speed top = params.wheels.max_speed;
  const Speed pace = Speed::from_raw(multiply_divide(most.raw(), min(asked.forward, top).raw(), top.raw()));
  bent.turning = limit(asked.turning + pace * response.turn, max(abs(asked.turning), fastest));
  active_ = bent.forward != asked.forward || bent.turning != asked.turning;
  return bent;
}

}  // namespace whisker::safety
