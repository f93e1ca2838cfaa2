// Speed of the whole loop relative to real time: core, plant, sensors; no trace.
#include <cstdio>

#include <benchmark/benchmark.h>

#include "host/harness/run/runner.hpp"
#include "host/harness/worlds/generate.hpp"

namespace whisker {
namespace {

void run_a_disc_field(benchmark::State& state) {
  worlds::Options options;
  options.noise = state.range(1) != 0;
  options.discs = static_cast<int>(state.range(0));
  double simulated_s = 0;
  double ticks = 0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    state.PauseTiming();
    options.seed = 1 + seed++ % 20;
    const Scenario scenario = worlds::generate(worlds::Kind::discs, options);
    state.ResumeTiming();
    const RunResult result = run(scenario);
    simulated_s += result.time_s;
    ticks += static_cast<double>(result.ticks);
  }
  state.counters["times_real_time"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
  state.counters["ticks_per_second"] = benchmark::Counter(ticks, benchmark::Counter::kIsRate);
}
BENCHMARK(run_a_disc_field)
    ->ArgNames({"discs", "noise"})
    ->Args({30, 0})
    ->Args({30, 1})
    ->Args({75, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace whisker

BENCHMARK_MAIN();
