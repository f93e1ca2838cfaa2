/// Colours and line styles of a run picture. The four path classes differ in hue, also for colour-blind eyes,
/// in lightness for grey print, and in width or dashes.
#pragma once

#include "firmware/planning/global/grid_map.hpp"
#include "host/lab/report/track.hpp"

namespace whisker::report {

struct Look {
  const char* name;    ///< class attribute in the SVG
  const char* label;   ///< in the legend
  const char* colour;  ///< #rrggbb
  double width;        ///< px
  const char* dashes;  ///< stroke-dasharray; "none": solid
};

/// Indexed by Doing.
constexpr Look kLooks[kDoings] = {
    {"free", "free driving", "#3487c4", 2.0, "none"},
    {"table", "table deflection", "#e69f00", 3.0, "none"},
    {"probing", "candidate heading", "#1f1f1f", 2.0, "5 2.5"},
    {"danger", "boundary following", "#b3261e", 3.6, "none"},
};

/// A planner's map: above the obstacles, below the path.
struct MapLook {
  planning::CellState state;
  const char* name;   ///< class attribute in the SVG
  const char* label;  ///< in the legend
  const char* fill;   ///< attributes
};
constexpr MapLook kMapLooks[] = {
    {planning::CellState::free, "map-free", "map: seen free", R"(fill="#58a879" fill-opacity="0.16")"},
    {planning::CellState::suspect, "map-suspect", "map: suspect", R"(fill="#b98a1f" fill-opacity="0.3")"},
    {planning::CellState::occupied, "map-occupied", "map: occupied", R"(fill="#6a4c93" fill-opacity="0.45")"},
};
constexpr const char* kMapColour = "#6a4c93";
constexpr const char* kMapDots = R"(fill="none" stroke="#6a4c93" stroke-linecap="round")";

constexpr const char* kObstacle = R"(fill="#d3d3d0" stroke="#6f6f6c" stroke-width="0.8")";
constexpr const char* kWall =
    R"(fill="none" stroke="#454543" stroke-width="2.4" stroke-linecap="round" stroke-linejoin="round")";
/// Narrower than any path, so that the colour of the path stays visible between close dots.
constexpr const char* kLookDot = R"(fill="none" stroke="#111" stroke-width="2" stroke-linecap="round")";
constexpr const char* kStraightWay =
    R"(fill="none" stroke="#8a8a86" stroke-width="1" stroke-dasharray="1 4")";
constexpr const char* kOutside = "#dcdcd8";
constexpr const char* kGoalColour = "#00795c";
constexpr const char* kContactColour = "#d0006f";

}  // namespace whisker::report
