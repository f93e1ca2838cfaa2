/// The legend of a run picture: the classes of the path with their share, the followed boundaries, then the
/// marks used.
#pragma once

#include <vector>

#include "host/lab/report/encounters.hpp"
#include "host/lab/report/run_svg.hpp"
#include "host/lab/report/svg.hpp"
#include "host/lab/report/track.hpp"

namespace whisker::report {

struct LegendContent {
  TrackSummary track;
  std::vector<Encounter> encounters;
  sim::Vec2 goal;
  std::vector<HandOver> hand_overs;
  const MapPicture* map = nullptr;
  bool looks = false;
  bool cones = false;
  bool end = false;
  bool contact = false;
  bool obstacles = false;
  bool walls = false;
  bool movers = false;
};

constexpr double kLegendWidth = 270;  ///< px, width of one column

/// Draws downwards from the corner; with 2 `columns` the marks are to the right of the classes. Returns the
/// height.
double draw_legend(Svg& svg, Point corner, int columns, const LegendContent& content);

}  // namespace whisker::report
