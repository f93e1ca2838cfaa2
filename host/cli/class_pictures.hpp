#pragma once

#include "host/worlds/generate.hpp"

namespace whisker::cli {

/// A run of the boundary planner in each class of worlds: docs/navigation.md.
struct ClassPicture {
  const char* file;
  worlds::Kind kind;
  worlds::Options options;
};

constexpr ClassPicture kClassPictures[] = {
    {"skirt_15_discs.svg", worlds::Kind::discs, {6, 15, false, false}},
    {"skirt_30_discs.svg", worlds::Kind::discs, {8, {}, false, false}},
    {"skirt_50_discs.svg", worlds::Kind::discs, {7, 50, false, false}},
    {"skirt_75_discs.svg", worlds::Kind::discs, {14, 75, true, false}},
    {"skirt_u_trap.svg", worlds::Kind::u_trap, {8, {}, false, false}},
    {"skirt_spiral.svg", worlds::Kind::spiral, {4, {}, false, false}},
    {"skirt_maze.svg", worlds::Kind::maze, {1, {}, false, false}},
    {"skirt_rooms.svg", worlds::Kind::rooms, {4, {}, false, false}},
    {"skirt_poles.svg", worlds::Kind::poles, {4, {}, false, false}},
    {"skirt_enclosed.svg", worlds::Kind::enclosed, {1, {}, false, false}},
};

/// The map planner beside the boundary planner in one world of a class: the first one, with seeds from 1,
/// whose goal both reach and in which the boundary planner's path ratio exceeds its median in the class; for
/// `enclosed` the first one that both report as unreachable.
struct MapPicturePair {
  const char* name;  ///< map_NAME.svg, map_NAME_skirt.svg
  worlds::Kind kind;
  worlds::Options options;  ///< without the seed
  double skirts_median;     ///< as in docs/campaign.md
};

constexpr MapPicturePair kMapPictures[] = {
    {"30_discs", worlds::Kind::discs, {}, 1.060},
    {"50_discs", worlds::Kind::discs, {1, 50, false, false}, 1.358},
    {"75_discs", worlds::Kind::discs, {1, 75, true, false}, 1.533},
    {"u_trap", worlds::Kind::u_trap, {}, 1.497},
    {"spiral", worlds::Kind::spiral, {}, 1.393},
    {"maze", worlds::Kind::maze, {}, 1.506},
    {"rooms", worlds::Kind::rooms, {}, 2.667},
    {"enclosed", worlds::Kind::enclosed, {}, 0},
};

}  // namespace whisker::cli
