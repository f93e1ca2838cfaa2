/// Draws one world of each kind; the caller checks whether it has the properties of the kind.
#pragma once

#include <vector>

#include "host/harness/scenario/scenario.hpp"
#include "host/harness/worlds/generate.hpp"
#include "host/harness/worlds/random.hpp"

namespace whisker::worlds {

/// Files have a resolution of 0.1 mm.
double tidy(double metres);
sim::Vec2 tidy(sim::Vec2 p);

/// A closed rectangle around the segment, half the thickness beyond each end.
std::vector<sim::Vec2> bar(sim::Vec2 a, sim::Vec2 b, double thickness);

/// Adds discs with centres in [low, high)^2, none within radius + kKeptFree of start or goal.
struct DiscField {
  int count;
  double radius_min, radius_max;
  double low, high;
};
void add_discs(Scenario& scenario, Random& random, const DiscField& field);

void draw_discs(Scenario& scenario, Random& random, const Options& options);
void draw_poles(Scenario& scenario, Random& random, const Options& options);
void draw_u_trap(Scenario& scenario, Random& random);
void draw_spiral(Scenario& scenario, Random& random);
void draw_maze(Scenario& scenario, Random& random);
void draw_rooms(Scenario& scenario, Random& random, const Options& options);
void draw_enclosed(Scenario& scenario, Random& random, const Options& options);
void draw_enclosed_at_wall(Scenario& scenario, Random& random, const Options& options);
void draw_gap_at_wall(Scenario& scenario, Random& random, const Options& options);
void draw_contest_maze(Scenario& scenario, Random& random);
void draw_gap(Scenario& scenario, Random& random, const Options& options);
void draw_disc_gap(Scenario& scenario, Random& random, const Options& options);

}  // namespace whisker::worlds
