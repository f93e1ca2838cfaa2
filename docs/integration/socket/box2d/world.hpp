// The obstacles of a scenario file as bodies of Box2D, and boxes that can be pushed.
#pragma once

#include <box2d/box2d.h>

#include <string>

struct Scenario {
  b2Vec2 start{0, 0};
  float heading = 0;  // rad
  b2Vec2 goal{0, 0};
  float tolerance = 0.1F;
};

// Builds the obstacles of the file into the world. Throws std::runtime_error or toml::parse_error.
Scenario load(const std::string& file, b2World& world);

// Boxes with sides of 10 to 20 cm and 0.2 to 0.8 kg, away from start and goal and from other bodies.
void scatter_boxes(b2World& world, const Scenario& scenario, int count, unsigned seed);

// The distance from `apex` of the nearest point of any body but `without` in the cone; infinite: none.
float nearest_in_cone(const b2World& world, const b2Body& without, b2Vec2 apex, float axis, float half);
