/// The robot's perception in a tick.
#pragma once

#include <stdint.h>

#include "firmware/perception/contacts.hpp"
#include "firmware/perception/echo.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/perception/mover.hpp"

namespace whisker::perception {

struct Percept {
  Echoes static_scan{};  ///< consensus of the readings taken since the body stood; pending until then
  Echoes moving_scan{};  ///< the same while it moves: the median of the last few readings of each beam
  bool sighted = false;  ///< a reading arrived at this tick; after Perception::put_off(): it is time to think
  const LocalGrid* local_grid = nullptr;        ///< clear ground nearby
  const Contacts* contacts = nullptr;           ///< obstacles found by touch; null: none
  ConeObservation observations[hal::kBeams]{};  ///< one per beam, taken in at this tick, or put off until it
  Mover mover;                                  ///< the nearest object that moves
  bool doubts = false;                          ///< Perception::doubts()
  uint8_t observed = 0;                         ///< one bit per beam that has one
};

}  // namespace whisker::perception
