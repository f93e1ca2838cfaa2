// The mean time to find the shortest path, over fifty worlds of a class.
#include <benchmark/benchmark.h>

#include <vector>

#include "host/paths/shortest.hpp"
#include "host/worlds/generate.hpp"

namespace whisker::paths {
namespace {

void shortest(benchmark::State& state, worlds::Kind kind, worlds::Options options) {
  std::vector<Scenario> scenarios;
  for (options.seed = 1; options.seed <= 50; ++options.seed) {
    scenarios.push_back(worlds::generate(kind, options));
  }
  std::size_t next = 0;
  for (auto _ : state) {
    const Scenario& s = scenarios[next++ % scenarios.size()];
    benchmark::DoNotOptimize(shortest_path(make_world(s), s.start.at, s.goal.at, 0.10));
  }
}

BENCHMARK_CAPTURE(shortest, discs, worlds::Kind::discs, {})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(shortest, 75_discs_in_a_box, worlds::Kind::discs, {1, 75, true, false})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(shortest, poles, worlds::Kind::poles, {})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(shortest, maze, worlds::Kind::maze, {})->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(shortest, rooms, worlds::Kind::rooms, {})->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace whisker::paths

BENCHMARK_MAIN();
