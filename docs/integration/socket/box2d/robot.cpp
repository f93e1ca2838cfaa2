#include "robot.hpp"

#include <cmath>

#include "world.hpp"

namespace {

constexpr float kMass = 0.8F;  // kg
constexpr float kGrip =
    0.12F;  // coefficient of friction of the tyres on a dusty floor: they slip when pulled hard
constexpr float kWeight = 9.81F;       // m/s^2
constexpr float kLag = 0.03F;          // s, of the motors
constexpr float kAcceleration = 1.5F;  // m/s^2, of the motors at most

}  // namespace

Robot::Robot(b2World& world, const nlohmann::json& hello, b2Vec2 at, float heading, float grip)
    : hello_(hello), grip_(grip) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = at;
  def.angle = heading;
  body_ = world.CreateBody(&def);
  b2CircleShape disc;
  disc.m_radius = hello_["body_radius_m"].get<float>();
  body_->CreateFixture(&disc, kMass / (b2_pi * disc.m_radius * disc.m_radius));
}

void Robot::turn(Wheel& wheel, b2Vec2 at, float dt) {
  const float step =
      b2Clamp((wheel.wanted - wheel.speed) * b2Min(1.0F, dt / kLag), -kAcceleration * dt, kAcceleration * dt);
  wheel.speed += step;
  wheel.travel += static_cast<double>(wheel.speed) * static_cast<double>(dt);
  // The tyre stops the motion between tread and floor, as far as it grips.
  const b2Vec2 arm = body_->GetWorldVector(at);
  const b2Vec2 ahead = body_->GetWorldVector({1, 0});
  const b2Vec2 sliding =
      body_->GetLinearVelocityFromWorldPoint(body_->GetPosition() + arm) - wheel.speed * ahead;
  const float inertia = body_->GetInertia() + 1e-9F;
  const float stiff = 1 / (1 / body_->GetMass() + arm.LengthSquared() / inertia);
  b2Vec2 impulse = -0.5F * stiff * sliding;
  const float most = grip_ * body_->GetMass() * kWeight / 2 * dt;
  if (impulse.Length() > most) {
    impulse *= most / impulse.Length();
    slipped_ += static_cast<double>(sliding.Length() * dt);
  }
  body_->ApplyLinearImpulse(impulse, body_->GetPosition() + arm, true);
}

void Robot::drive(float dt) {
  const float half = hello_["wheel_track_m"].get<float>() / 2;
  turn(wheel_[0], {0, half}, dt);
  turn(wheel_[1], {0, -half}, dt);
}

nlohmann::json Robot::sense(const b2World& world, double t_s, bool ranges) const {
  const double per_m = hello_["encoder_counts_per_m"].get<double>();
  nlohmann::json line;
  line["t_s"] = t_s;
  for (const Wheel& wheel : wheel_)
    line["counts"].push_back(static_cast<long>(std::floor(wheel.travel * per_m)));
  for (const nlohmann::json& beam : hello_["beams"]) {
    constexpr float kDegree = b2_pi / 180;
    const b2Vec2 apex = body_->GetWorldPoint({beam["x_m"].get<float>(), beam["y_m"].get<float>()});
    const float axis = body_->GetAngle() + beam["angle_deg"].get<float>() * kDegree;
    const float far =
        ranges ? nearest_in_cone(world, *body_, apex, axis, beam["cone_deg"].get<float>() / 2 * kDegree) : 0;
    if (!ranges) {
      line["range_m"].push_back(nullptr);
    } else if (far >= beam["max_m"].get<float>()) {
      line["range_m"].push_back("clear");
    } else {
      line["range_m"].push_back(far);
    }
  }
  return line;
}
