#include "hal/boards/pico/encoders.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/pico/clock.hpp"
#include "hal/boards/pico/pins.hpp"
#include "hal/boards/pico/reg/pio.hpp"

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kMachines = 2;
constexpr uint8_t kPins[kMachines] = {wiring::kLeftEncoder, wiring::kRightEncoder};
constexpr uint32_t kDivider = kCoreHz / 1000000;  // 1 us an instruction
constexpr uint32_t kFreshUs = 100;
constexpr uint32_t kQueue = 4;

// Instructions of a state machine: RP2040 data sheet, 3.4.
constexpr uint16_t jump(uint16_t to) noexcept { return to; }
constexpr uint16_t jump_and_take_one(uint16_t to) noexcept { return static_cast<uint16_t>(0x0040 | to); }
constexpr uint16_t kInvertX = 0xA029;    // mov x, ~x
constexpr uint16_t kXIntoIn = 0xA0C1;    // mov isr, x
constexpr uint16_t kPush = 0x8000;       // push noblock
constexpr uint16_t kYIntoIn = 0xA0C2;    // mov isr, y
constexpr uint16_t kClearIn = 0xA0C3;    // mov isr, null
constexpr uint16_t kTakePins = 0x4002;   // in pins, 2
constexpr uint16_t kInIntoOut = 0xA0E6;  // mov osr, isr
constexpr uint16_t kTwoIntoY = 0x6042;   // out y, 2
constexpr uint16_t kInIntoY = 0xA046;    // mov y, isr
constexpr uint16_t kJumpByIn = 0xA0A6;   // mov pc, isr
constexpr uint16_t kZeroIntoX = 0xE020;  // set x, 0

constexpr uint16_t kAdd = 16, kTake = 20, kPublish = 21, kEnd = 28;

struct Program {
  uint16_t at[32];
};

/// x is the count, y the last levels of both pins. The levels before and now are the place of a jump. A leads
/// B when a wheel turns forward; of two levels that change at once, nothing is known, and the count stays.
constexpr Program program() noexcept {
  Program p{};
  constexpr uint8_t kTurn[4] = {0, 1, 3, 2};  // quarter turns by the levels of B and A
  for (uint16_t before = 0; before < 4; ++before) {
    for (uint16_t now = 0; now < 4; ++now) {
      const int step = (kTurn[now] - kTurn[before]) & 3;
      p.at[before * 4 + now] = jump(step == 1 ? kAdd : step == 3 ? kTake : kPublish);
    }
  }
  constexpr uint16_t kRest[] = {
      kInvertX,  // 16: x + 1 is the complement of its complement minus 1
      jump_and_take_one(kAdd + 2),
      kInvertX,
      jump(kPublish),
      jump_and_take_one(kPublish),  // 20
      kXIntoIn,                     // 21
      kPush,
      kYIntoIn,
      kTakePins,
      kInIntoOut,
      kTwoIntoY,
      kJumpByIn,
  };
  for (uint16_t i = 0; i < sizeof kRest / sizeof kRest[0]; ++i) p.at[kAdd + i] = kRest[i];
  return p;
}

constexpr uint16_t kBegin[] = {kZeroIntoX, kClearIn, kTakePins, kInIntoY, jump(kPublish)};

constexpr Register of_machine(Register first, uint32_t machine) noexcept {
  return {static_cast<uint16_t>(first.offset + machine * (pio::kSm1Clkdiv.offset - pio::kSm0Clkdiv.offset))};
}

void execute(uint32_t machine, uint16_t instruction) noexcept {
  store(base::kPio0, of_machine(pio::kSm0Instr, machine), instruction);
}

bool is_empty(uint32_t machine) noexcept { return (get(base::kPio0, pio::kRxempty) >> machine & 1U) != 0; }

uint32_t take(uint32_t machine) noexcept { return load(base::kPio0 + pio::kRxf0.offset + 4 * machine); }

bool count_of(uint32_t machine, uint32_t& count) noexcept {
  for (uint32_t i = 0; i < kQueue && !is_empty(machine); ++i) take(machine);
  for (Patience patience = Patience::for_us(kFreshUs, kCoreHz); is_empty(machine);) {
    if (!patience.spend()) return false;
  }
  count = take(machine) % hal::kEncoderModulus;
  return true;
}

}  // namespace

void Encoders::start() noexcept {
  static constexpr Program kProgram = program();
  for (uint32_t i = 0; i < kEnd; ++i) store(base::kPio0 + pio::kInstrMem0.offset + 4 * i, kProgram.at[i]);
  for (uint32_t m = 0; m < kMachines; ++m) {
    store(base::kPio0, of_machine(pio::kSm0Clkdiv, m), bits(pio::kInt, kDivider));
    store(base::kPio0, of_machine(pio::kSm0Execctrl, m), bits(pio::kWrapTop, kEnd - 1));
    store(base::kPio0, of_machine(pio::kSm0Shiftctrl, m), mask(pio::kOutShiftdir));
    store(base::kPio0, of_machine(pio::kSm0Pinctrl, m), bits(pio::kInBase, kPins[m]));
    for (const uint16_t instruction : kBegin) execute(m, instruction);
  }
  store(base::kPio0, pio::kCtrl, bits(pio::kSmEnable, (1U << kMachines) - 1));
}

bool Encoders::read(hal::EncoderCounts& out) noexcept {
  hal::EncoderCounts counts{};
  if (count_of(0, counts.left) && count_of(1, counts.right)) {
    out = counts;
    return true;
  }
  ++not_ready_;
  return false;
}

void Encoders::collect(Troubles& troubles) noexcept {
  troubles.count(Trouble::counts_not_ready, not_ready_);
  not_ready_ = 0;
}

}  // namespace whisker::hal::pico
