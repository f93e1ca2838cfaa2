#include "host/harness/scenario/world.hpp"

#include <utility>

#include "host/harness/scenario/shapes.hpp"
#include "host/harness/sim/random.hpp"
#include "host/harness/sim/streams.hpp"

namespace whisker {

namespace {

enum Kind : std::uint32_t { kDiscs, kMovers, kPolygons, kWalls, kBounds };

/// Draws which obstacles absorb; all edges of one are alike.
class SoftDraw {
 public:
  explicit SoftDraw(const Scenario& s) : seed_(s.seed), share_(s.sensor.soft) {}

  /// edges(i): count of entries of obstacle i.
  template <class Edges>
  void add(Kind kind, std::size_t count, Edges&& edges) {
    sim::Random random(seed_, sim::kStreamSoft + kind);
    for (std::size_t i = 0; i < count; ++i) {
      soft_.insert(soft_.end(), edges(i), random.uniform() < share_ ? 1 : 0);
    }
  }
  std::vector<std::uint8_t> take() { return std::move(soft_); }

 private:
  std::uint64_t seed_;
  double share_;
  std::vector<std::uint8_t> soft_;
};

std::vector<std::uint8_t> soft_obstacles(const Scenario& s) {
  if (s.sensor.soft <= 0) return {};
  const auto one = [](std::size_t) { return std::size_t{1}; };
  SoftDraw draw(s);
  draw.add(kDiscs, s.discs.size(), one);
  draw.add(kMovers, s.movers.size(), one);
  draw.add(kPolygons, s.polygons.size(), [&](std::size_t i) { return s.polygons[i].size(); });
  draw.add(kWalls, s.walls.size(), [&](std::size_t i) { return s.walls[i].size() - 1; });
  draw.add(kBounds, s.bounds ? 1 : 0, [](std::size_t) { return std::size_t{4}; });
  return draw.take();
}

}  // namespace

World make_world(const Scenario& scenario) {
  World world{scenario.discs, {}, scenario.movers, soft_obstacles(scenario)};
  for (const auto& polygon : scenario.polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) world.segments.push_back(edge(polygon, i));
  }
  for (const auto& wall : scenario.walls) {
    for (std::size_t i = 0; i + 1 < wall.size(); ++i) world.segments.push_back({wall[i], wall[i + 1]});
  }
  if (scenario.bounds) {
    const auto [min, max] = *scenario.bounds;
    const std::vector<sim::Vec2> outline{min, {max.x, min.y}, max, {min.x, max.y}};
    for (std::size_t i = 0; i < outline.size(); ++i) world.segments.push_back(edge(outline, i));
  }
  return world;
}

}  // namespace whisker
