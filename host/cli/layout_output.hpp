/// What `whisker robot layout` prints and writes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/campaign/layout_score.hpp"

namespace whisker::cli {

struct LayoutTrade {
  std::string sensor;  ///< the name of its model
  Sensor what;
  Params robot;  ///< without a layout
  campaign::LayoutGrid grid;
  std::uint64_t count = 0;  ///< missions of a layout in each kind of world
  std::uint64_t seed = 1;
  std::vector<campaign::LayoutScore> ranked;  ///< not empty, best first
};

/// Lines for people, each ending in a newline.
std::string layout_words(const LayoutTrade& trade);
/// One JSON object without provenance.
std::string layout_json(const LayoutTrade& trade);
/// The chart.
std::string layout_picture(const LayoutTrade& trade);
/// The best layout as a robot file with its [sensor].
std::string layout_robot_file(const LayoutTrade& trade);
/// The mountings that check() refuses: "cone_too_narrow 3, beams_crossed 1".
std::string refused_words(const campaign::LayoutGrid& grid);

}  // namespace whisker::cli
