/// The legend of a run picture: the path's classes with their share, the edges met, then the marks that
/// occur.
#pragma once

#include <vector>

#include "host/report/encounters.hpp"
#include "host/report/hand_overs.hpp"
#include "host/report/run_svg.hpp"
#include "host/report/svg.hpp"
#include "host/report/track.hpp"

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

constexpr double kLegendWidth = 270;  ///< px, of one column

/// Draws from the corner down; with `columns` 2 the marks stand to the right of the classes. Returns its
/// height.
double draw_legend(Svg& svg, Point corner, int columns, const LegendContent& content);

}  // namespace whisker::report
