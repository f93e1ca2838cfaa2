// Whisker's core drives a robot in Box2D: rigid bodies, tyres that slip, boxes that can be pushed.
//
// usage: box2d_simulator WHISKER SCENARIO.toml [BOXES [SEED [GRIP]]]
// GRIP: coefficient of friction of the tyres, 0.7 by default. Prints one JSON object. Exit status: 0 the core
// says reached, 3 anything else, 5 something was touched, 2 bad input.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "core.hpp"
#include "robot.hpp"
#include "world.hpp"

namespace {

constexpr int kSteps = 10;            // of the engine in a tick of 10 ms
constexpr int kLongest = 100 * 1800;  // ticks

// Counts what the robot touches.
class Touches final : public b2ContactListener {
 public:
  explicit Touches(const b2Body& robot) : robot_(&robot) {}
  void BeginContact(b2Contact* contact) override {
    if (contact->GetFixtureA()->GetBody() == robot_ || contact->GetFixtureB()->GetBody() == robot_) ++count;
  }
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override {
    if (contact->GetFixtureA()->GetBody() != robot_ && contact->GetFixtureB()->GetBody() != robot_) return;
    for (int i = 0; i < impulse->count; ++i) largest = b2Max(largest, impulse->normalImpulses[i]);
  }
  int count = 0;
  float largest = 0;  // Ns

 private:
  const b2Body* robot_;
};

int drive(int argc, char** argv) {
  b2World world(b2Vec2(0, 0));
  const Scenario scenario = load(argv[2], world);
  scatter_boxes(world, scenario, argc > 3 ? std::atoi(argv[3]) : 0,
                argc > 4 ? static_cast<unsigned>(std::atoi(argv[4])) : 1);
  Core core(argv[1]);
  const nlohmann::json hello = core.ask(
      {{"whisker", 1},
       {"start",
        {{"x_m", scenario.start.x},
         {"y_m", scenario.start.y},
         {"heading_deg", scenario.heading * 180 / b2_pi}}},
       {"goal", {{"x_m", scenario.goal.x}, {"y_m", scenario.goal.y}, {"tolerance_m", scenario.tolerance}}}});
  Robot robot(world, hello, scenario.start, scenario.heading,
              argc > 5 ? static_cast<float>(std::atof(argv[5])) : 0.7F);
  Touches touches(robot.body());
  world.SetContactListener(&touches);
  const double period_s = hello["period_s"].get<double>();
  const int readings = static_cast<int>(std::lround(1 / (hello["range_rate_hz"].get<double>() * period_s)));
  nlohmann::json answer;
  int tick = 0;
  for (; tick < kLongest && touches.count == 0; ++tick) {
    answer = core.ask(robot.sense(world, tick * period_s, tick % readings == 0));
    if (answer["outcome"] != "running") break;
    robot.command(answer["wheel_mps"][0].get<float>(), answer["wheel_mps"][1].get<float>());
    for (int i = 0; i < kSteps; ++i) {
      const float dt = static_cast<float>(period_s) / kSteps;
      robot.drive(dt);
      world.Step(dt, 8, 3);
    }
  }
  nlohmann::json result;
  result["outcome"] = touches.count > 0 ? nlohmann::json("contact") : answer["outcome"];
  result["time_s"] = tick * period_s;
  result["true_distance_m"] = (robot.body().GetPosition() - scenario.goal).Length();
  result["touches"] = touches.count;
  result["largest_impulse_Ns"] = touches.largest;
  result["slipped_m"] = robot.slipped();
  std::printf("%s\n", result.dump().c_str());
  return touches.count > 0 ? 5 : answer["outcome"] == "reached" ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 6) {
    std::fputs("usage: box2d_simulator WHISKER SCENARIO.toml [BOXES [SEED [GRIP]]]\n", stderr);
    return 2;
  }
  try {
    return drive(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "box2d_simulator: %s\n", e.what());
    return 2;
  }
}
