/// The boundary planner with a map as global planner.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/planning/global/wavefront_planner.hpp"

namespace whisker::planning {

struct MapSize {
  int32_t bytes = 0;  ///< memory for cells, plan and bookkeeping
  GridShape shape;    ///< the grid that fits into it
};
inline constexpr MapSize kMapSizes[] = {{1024, {1, 48, 125_mm}},
                                        {2048, {2, 56, 100_mm}},
                                        {4096, {3, 80, 80_mm}},
                                        {8192, {4, 124, 80_mm}},
                                        {16384, {6, 168, 80_mm}}};
/// Size of the map if none is chosen.
constexpr int32_t kUsualMapBytes = 2048;

/// Shape of a map of this size; without cells if there is no such map.
constexpr GridShape map_shape(int32_t bytes) noexcept {
  for (const MapSize& size : kMapSizes) {
    if (size.bytes == bytes) return size.shape;
  }
  return {};
}

/// A map size known at compile time.
template <int32_t kOfBytes>
struct MapBytes {
  static constexpr int32_t kBytes = kOfBytes;
};

/// Calls visit(MapBytes) for each size.
template <size_t kAt = 0, class Visit>
constexpr void for_each_map(Visit&& visit) noexcept {
  visit(MapBytes<kMapSizes[kAt].bytes>{});
  if constexpr (kAt + 1 < sizeof kMapSizes / sizeof *kMapSizes) for_each_map<kAt + 1>(visit);
}

/// The memory of a map's cells.
template <int kBytes>
struct MapStorage {
  GridWord words[static_cast<size_t>(kGridPlanes * map_shape(kBytes).size())];
  static_assert(sizeof(words) + sizeof(WavefrontPlanner) <= size_t{kBytes});
};

/// A global planner with storage for its map.
template <int kBytes>
class MapOf {
 public:
  explicit MapOf(const Params& params) noexcept : guide(params, map_shape(kBytes), storage_.words) {}
  WavefrontPlanner guide;

 private:
  MapStorage<kBytes> storage_;
};

/// The complete planner; the response table may deflect its heading.
template <int kBytes>
struct TableMapPlanner {
  /// Both references must outlive it.
  TableMapPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept
      : law(table), guide(params, map_shape(kBytes), storage.words), planner(params, law, &guide) {}
  TableDeflection law;
  WavefrontPlanner guide;
  BoundaryPlanner planner;
  MapStorage<kBytes> storage;  // last, so that the other members have short addresses
};

}  // namespace whisker::planning
