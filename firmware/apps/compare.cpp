// Cost of the fuzzy stage with three engines: one line each, with the minimum, mean and maximum instructions
// over a grid of inputs. The only program here that uses floating point.
#include "firmware/apps/float_inference.hpp"
#include "firmware/apps/work.hpp"
#include "firmware/fuzzy/exact.hpp"
#include "firmware/fuzzy/response_table.hpp"
#include "firmware/fuzzy/rules.hpp"

using namespace whisker;

/// An engine's call operator as an ordinary function, as ARM and RISC-V pass `this`, so that the same code
/// calls every engine.
using Infer = fuzzy::Response (*)(const void* engine, fuzzy::Inputs);

/// Returns at once: measures its one instruction and the call, which are then subtracted.
fuzzy::Response idle(const void*, fuzzy::Inputs) asm("whisker_idle");
#ifdef __riscv
asm(".section .text.idle, \"ax\"\nwhisker_idle: ret\n.previous");
#else
asm(".section .text.idle, \"ax\"\n.thumb_func\nwhisker_idle: bx lr\n.previous");
#endif

namespace {

struct Floating {
  const images::FloatRules& rules;
  fuzzy::Response operator()(fuzzy::Inputs in) const noexcept {
    const images::FloatResponse r = images::infer(rules, static_cast<float>(in.distance.raw()) / 128,
                                                  static_cast<float>(in.bias.raw()) / 128);
    const auto q14 = [](float x) { return Q14::from_raw(static_cast<int16_t>(x * 16384)); };
    return {q14(r.turn), q14(r.step)};
  }
};

[[gnu::noinline]] uint32_t timed(Infer infer, const void* engine, fuzzy::Inputs in) {
  hal::Meter& meter = hal::board().meter;
  const uint32_t from = meter.stamp();
  const fuzzy::Response result = infer(engine, in);
  const uint32_t to = meter.stamp();
  asm volatile("" : : "r"(&result) : "memory");
  return meter.between(from, to);
}

images::Work measure(Infer infer, const void* engine) {
  images::Work work;
  for (int d = 0; d <= 1280; d += 27) {
    for (int r = -1024; r <= 1024; r += 37) {
      const fuzzy::Inputs in{Q7::from_raw(static_cast<int16_t>(d)), Q7::from_raw(static_cast<int16_t>(r))};
      work.add(timed(infer, engine, in));
    }
  }
  return work;
}

/// From the engine's first instruction to its return, inclusive.
template <class Engine>
void report(const char* name, const Engine& engine) {
  fuzzy::Response (Engine::*const member)(fuzzy::Inputs) const noexcept = &Engine::operator();
  Infer infer = nullptr;
  __builtin_memcpy(&infer, &member, sizeof infer);
  const uint32_t call = measure(idle, nullptr).least - 1;
  images::print_work(name, measure(infer, &engine), call);
}

}  // namespace

int main() {
  const images::FloatRules float_rules = images::as_float(fuzzy::kRules);
  report("table", fuzzy::Bilinear{fuzzy::kResponseTable});
  report("fixed", fuzzy::Exact{fuzzy::kRules});
  report("float", Floating{float_rules});
  return 0;
}
