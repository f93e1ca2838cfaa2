/// Measures one beam from its readings of a wall during a turn on the spot.
#pragma once

#include "host/lab/calibration/wall_model.hpp"

namespace whisker::calibration {

/// Why a beam could not be measured.
enum class Trouble {
  none,
  few_readings,
  not_enough_turn,
  nothing_seen,  ///< hardly an echo
  no_wall,       ///< echoes, but not of a flat wall
  second_wall,   ///< another wall or object is not much farther away
  too_noisy,     ///< the result is too uncertain to be used
};

/// Degrees and metres; each error is an estimate of the standard deviation.
struct BeamFit {
  Trouble trouble = Trouble::few_readings;
  double axis_deg = 0;  ///< from straight ahead
  double axis_error_deg = 0;
  double edge_deg = 0;  ///< half cone + L: off the axis, as far as the wall is seen
  double edge_error_deg = 0;
  double sure_edge_deg = 0;    ///< up to here, hardly an echo is missing; edge_deg if the edge is sharp
  bool edge_is_bound = false;  ///< the wall left the range before its echo was lost: the edge lies farther
  double half_cone_deg = 0;    ///< effective at this distance
  double half_cone_error_deg = 0;
  double wall_error_m = 0;
  double wall_m = 0;    ///< from the centre of the turn
  double sigma_m = 0;   ///< standard deviation of the distances from the wall
  double within_m = 0;  ///< farther echoes were left out
  double turn_deg = 0;  ///< of the body
  double second_m = 0;  ///< with second_wall: its distance
  int readings = 0;
  int on_wall = 0;   ///< echoes of the wall
  int dropouts = 0;  ///< within the edges: readings without an echo
  int wild = 0;      ///< within the edges: echoes of something else
  int phantoms = 0;  ///< beyond the edges: echoes
};

/// wall_deg: the heading at which straight ahead meets the wall squarely.
BeamFit fit_beam(const Samples& samples, const Believed& beam, double wall_deg);

}  // namespace whisker::calibration
