#include "host/harness/run/map_picture.hpp"

#include <algorithm>

namespace whisker {
namespace {

constexpr std::int32_t kEveryMs = 100;

std::vector<planning::Cell> way_of(const RecordingGuide& guide) {
  const planning::GridMap& map = guide.inside().map();
  const planning::Wavefront& wavefront = guide.inside().wavefront();
  const planning::Cell goal = map.place(guide.goal());
  std::vector<planning::Cell> way;
  planning::Cell p = map.place(guide.body());
  if (wavefront.phase(map, p) < 0) return way;
  const auto cells =
      static_cast<std::size_t>(map.shape().columns()) * static_cast<std::size_t>(map.shape().rows);
  for (planning::Cell next; way.size() < cells && wavefront.next(map, p, goal, next); p = next)
    way.push_back(next);
  return way;
}

}  // namespace

MapPicture picture_of(const RecordingGuide& guide) {
  const planning::GridMap& map = guide.inside().map();
  MapPicture picture;
  picture.corner = map.corner();
  picture.columns = map.shape().columns();
  picture.rows = map.shape().rows;
  picture.cell_m = map.cell().raw() / 1e6;
  picture.cells.reserve(static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows));
  for (std::int32_t y = 0; y < picture.rows; ++y)
    for (std::int32_t x = 0; x < picture.columns; ++x) picture.cells.push_back(map.at({x, y}));
  picture.way = way_of(guide);
  return picture;
}

MapWatch::MapWatch(const Params& params)
    : every_(std::max(1, kEveryMs / params.safety.period.raw())), since_(every_) {}

bool MapWatch::look(const RecordingGuide* guide) {
  ++since_;
  if (guide == nullptr || !guide->started() || since_ < every_ || !guide->inside().planned()) return false;
  since_ = 0;
  last_ = picture_of(*guide);
  return true;
}

}  // namespace whisker
