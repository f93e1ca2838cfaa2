#include "tests/sim/scripted_drive.hpp"

#include "host/harness/sim/plant.hpp"

namespace whisker::sim {
namespace {

class Fnv1a {
 public:
  void add(uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) {
      hash_ = (hash_ ^ ((value >> (8 * i)) & 0xFF)) * UINT64_C(0x100000001B3);
    }
  }
  void add(double value) {
    uint64_t bits;
    __builtin_memcpy(&bits, &value, sizeof bits);
    add(bits, 8);
  }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = UINT64_C(0xCBF29CE484222325);
};

void add(Fnv1a& hash, const Plant& plant) {
  hash.add(plant.pose().at.x);
  hash.add(plant.pose().at.y);
  hash.add(plant.pose().heading);
  hash.add(plant.v_left());
  hash.add(plant.v_right());
  hash.add(plant.min_clearance());
  hash.add(plant.path_length());
  hash.add(plant.encoders().left, 4);
  hash.add(plant.encoders().right, 4);
  const hal::RangeReadings ranges = plant.ranges();
  for (const hal::RangeReading& reading : ranges.beam) {
    hash.add(reading.mm, 2);
    hash.add(static_cast<uint64_t>(reading.status), 1);
    hash.add(reading.age_ms, 1);
    hash.add(reading.sequence, 1);
  }
}

}  // namespace

uint64_t scripted_drive(uint64_t seed) {
  const Disc discs[] = {{{1.0, 0.6}, 0.3}, {{0.4, -0.7}, 0.25}, {{-1.2, 0.1}, 0.5}, {{0.2, 1.9}, 0.02}};
  const Segment segments[] = {
      {{-2, -2}, {2, -2}}, {{2, -2}, {2, 2.2}}, {{2, 2.2}, {-2, 2}}, {{1.5, 0}, {1.5, 0}}};
  const Vec2 path[] = {{-0.8, 1.3}, {0.9, 1.5}, {0.9, 1.9}};
  const MovingDisc mover{path, 3, 0.1, 0.25, 0.4};
  const WorldView world{discs, 4, segments, 4, &mover, 1};

  RobotSpec robot;
  robot.rate_hz = 47;  // never synchronous with the ticks
  for (BeamSpec& beam : robot.beams) {
    const SinCos axis = sin_cos(beam.angle);
    beam.x = 0.03 * axis.cos;
    beam.y = 0.03 * axis.sin;
  }
  const NoiseSpec noise{0.01, 0.05, 0.03, 0.005, 0.02};
  Plant plant(world, robot, noise, seed, {{-0.3, 0.2}, 0.1});

  const struct {
    int ticks;
    hal::WheelSpeeds speeds;
  } script[] = {{150, {1500, 1400}},  {80, {-1200, 1200}}, {200, {2500, 2900}}, {60, {3000, -400}},
                {120, {-800, -1000}}, {50, {0, 0}},        {90, {-2000, 2000}}, {2000, {3000, 2950}}};
  Fnv1a hash;
  add(hash, plant);
  for (const auto& part : script) {
    plant.command(part.speeds);
    for (int i = 0; i < part.ticks; ++i) {
      plant.advance();
      add(hash, plant);
    }
  }
  hash.add(plant.contact_time());
  return hash.value();
}

}  // namespace whisker::sim
