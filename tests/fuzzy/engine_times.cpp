// Nanoseconds per inference of each engine on this computer, over the same grid of inputs.
#include <chrono>
#include <cstdio>

#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"
#include "tests/fuzzy/fuzzylite_engine.hpp"
#include "tests/fuzzy/inputs.hpp"

namespace {

using namespace whisker::fuzzy;

/// The minimum of several rounds: other programs can only add time.
template <class F>
void report(const char* name, int rounds, const F& infer) {
  double least = 1e12;
  for (int round = 0; round < rounds; ++round) {
    int count = 0;
    const auto from = std::chrono::steady_clock::now();
    for (int d = 0; d <= kDistanceMax; d += 9) {
      for (int r = -kBiasMax; r <= kBiasMax; r += 17, ++count) infer(d, r);
    }
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - from;
    if (spent.count() / count < least) least = spent.count() / count;
  }
  std::printf("%s %.1f\n", name, least);
}

template <class Engine>
void report_engine(const char* name, const Engine& engine) {
  report(name, 50, [&](int d, int r) {
    const Response response = engine(inputs(d, r));
    asm volatile("" : : "r"(&response) : "memory");
  });
}

}  // namespace

int main() {
  report_engine("table", Bilinear{kResponseTable});
  report_engine("fixed", Exact{kRules});
  const auto engine = fuzzylite_engine(kRules);
  report("fuzzylite", 3, [&](int d, int r) {
    engine->setInputValue("D", d / 128.0);
    engine->setInputValue("R", r / 128.0);
    engine->process();
  });
}
