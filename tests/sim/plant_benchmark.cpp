#include <benchmark/benchmark.h>

#include "host/sim/plant.hpp"
#include "host/sim/random.hpp"

namespace whisker::sim {
namespace {

/// A closed yard of 8 m with 30 discs. The robot drives and turns at changing speeds around the middle; a
/// contact restarts it.
void plant_among_30_discs(benchmark::State& state) {
  Random random(1, 0);
  Disc discs[30];
  for (Disc& disc : discs) {
    const double angle = 2 * kPi * random.uniform();
    const double away = 0.8 + 3 * random.uniform();
    disc = {{away * sin_cos(angle).cos, away * sin_cos(angle).sin}, 0.05 + 0.4 * random.uniform()};
  }
  const Segment box[] = {{{-4, -4}, {4, -4}}, {{4, -4}, {4, 4}}, {{4, 4}, {-4, 4}}, {{-4, 4}, {-4, -4}}};
  const WorldView world{discs, 30, box, 4, nullptr, 0};
  const NoiseSpec noisy{0.01, 0.02, 0.01, 0.005, 0.005};
  const NoiseSpec noise = state.range(0) != 0 ? noisy : NoiseSpec{};
  const RobotSpec robot;

  Plant plant(world, robot, noise, 1, {});
  int tick = 0;
  int contacts = 0;
  for (auto _ : state) {
    if (tick++ % 100 == 0) {
      const auto speed = [&] { return static_cast<int16_t>(3000 * (1.4 * random.uniform() - 0.4)); };
      const int16_t left = speed();
      plant.command({left, speed()});
    }
    plant.advance();
    benchmark::DoNotOptimize(plant.ranges());
    benchmark::DoNotOptimize(plant.encoders());
    if (plant.in_contact()) {
      plant = Plant(world, robot, noise, 1, {});
      ++contacts;
    }
  }
  state.counters["times_real_time"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * robot.period_s, benchmark::Counter::kIsRate);
  state.counters["contacts"] = contacts;
}
BENCHMARK(plant_among_30_discs)->ArgName("noise")->Arg(0)->Arg(1);

}  // namespace
}  // namespace whisker::sim

BENCHMARK_MAIN();
