#pragma once

#include "host/worlds/generate.hpp"

namespace whisker::cli {

/// A drive of the skirt planner in each class of worlds, chosen for what it shows: docs/skirt-pictures.md.
struct ClassPicture {
  const char* file;
  worlds::Kind kind;
  worlds::Options options;
};

constexpr ClassPicture kClassPictures[] = {
    {"skirt_15_discs.svg", worlds::Kind::discs, {6, 15, false, false}},
    {"skirt_30_discs.svg", worlds::Kind::discs, {8, {}, false, false}},
    {"skirt_50_discs.svg", worlds::Kind::discs, {7, 50, false, false}},
    {"skirt_75_discs.svg", worlds::Kind::discs, {4, 75, true, false}},
    {"skirt_u_trap.svg", worlds::Kind::u_trap, {8, {}, false, false}},
    {"skirt_spiral.svg", worlds::Kind::spiral, {4, {}, false, false}},
    {"skirt_maze.svg", worlds::Kind::maze, {1, {}, false, false}},
    {"skirt_rooms.svg", worlds::Kind::rooms, {4, {}, false, false}},
    {"skirt_poles.svg", worlds::Kind::poles, {4, {}, false, false}},
    {"skirt_enclosed.svg", worlds::Kind::enclosed, {2, {}, false, false}},
};

}  // namespace whisker::cli
