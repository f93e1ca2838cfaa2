// A rigid body on two driven wheels that grip and slip.
#pragma once

#include <box2d/box2d.h>

#include <nlohmann/json.hpp>

class Robot {
 public:
  // hello: the core's answer to the first line. grip: coefficient of friction of the tyres.
  Robot(b2World& world, const nlohmann::json& hello, b2Vec2 at, float heading, float grip);

  void command(float left, float right) { wheel_[0].wanted = left, wheel_[1].wanted = right; }
  // Motors and tyres act for this time; call it before b2World::Step().
  void drive(float dt);
  // The line of a tick.
  nlohmann::json sense(const b2World& world, double t_s, bool ranges) const;

  const b2Body& body() const { return *body_; }
  double slipped() const { return slipped_; }  // m of tread

 private:
  struct Wheel {
    float wanted = 0;   // m/s
    float speed = 0;    // of the tread
    double travel = 0;  // of the tread, m
  };
  void turn(Wheel& wheel, b2Vec2 at, float dt);

  nlohmann::json hello_;
  float grip_;
  b2Body* body_;
  Wheel wheel_[2];
  double slipped_ = 0;
};
