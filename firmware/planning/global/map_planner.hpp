/// The boundary planner with a map as global planner.
#pragma once

#include <stdint.h>

#include "firmware/planning/boundary/table_boundary_planner.hpp"
#include "firmware/planning/global/wavefront_planner.hpp"

namespace whisker::planning {

/// Memory of a map of this size: cells, plan and bookkeeping.
template <int kBytes>
constexpr GridShape kMapShape{};
template <>
inline constexpr GridShape kMapShape<1024>{1, 48, 125_mm};
template <>
inline constexpr GridShape kMapShape<2048>{2, 56, 100_mm};
template <>
inline constexpr GridShape kMapShape<4096>{3, 80, 80_mm};
template <>
inline constexpr GridShape kMapShape<8192>{4, 124, micrometres(66700)};
template <>
inline constexpr GridShape kMapShape<16384>{6, 168, 50_mm};

/// A map size known at compile time.
template <int kBytes>
struct MapBytes {
  static constexpr int kValue = kBytes;
};

/// Returns make(MapBytes<bytes>), or nothing if there is no such map.
template <class Made, class Make>
Made with_map_of(int32_t bytes, const Make& make) {
  switch (bytes) {
    case 1024: return make(MapBytes<1024>());
    case 2048: return make(MapBytes<2048>());
    case 4096: return make(MapBytes<4096>());
    case 8192: return make(MapBytes<8192>());
    case 16384: return make(MapBytes<16384>());
    default: return Made();
  }
}

/// A global planner with storage for its map.
template <int kBytes>
class MapOf {
 public:
  explicit MapOf(const Params& params) noexcept : guide(params, kMapShape<kBytes>, storage_) {}
  WavefrontPlanner guide;

 private:
  GridWord storage_[kGridPlanes * kMapShape<kBytes>.size()];
};
static_assert(sizeof(MapOf<1024>) <= 1024);
static_assert(sizeof(MapOf<2048>) <= 2048);
static_assert(sizeof(MapOf<4096>) <= 4096);
static_assert(sizeof(MapOf<8192>) <= 8192);
static_assert(sizeof(MapOf<16384>) <= 16384);

/// The complete planner; the response table deflects its heading.
template <int kBytes>
struct TableMapPlanner {
  /// Both references must outlive it.
  TableMapPlanner(const Params& params, const fuzzy::Engine::Table& table) noexcept
      : law(table), map(params), planner(params, law, &map.guide) {}
  TableDeflection law;
  MapOf<kBytes> map;
  BoundaryPlanner planner;
};

}  // namespace whisker::planning
