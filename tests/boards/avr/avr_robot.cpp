#include "tests/boards/avr/avr_robot.hpp"

#include <cmath>
#include <stdexcept>

#include "hal/boards/atmega1284p/pins.hpp"
#include "hal/boards/atmega1284p/robot_params.hpp"
#include "hal/boards/common/analogue_ir.hpp"
#include "hal/boards/common/counts.hpp"
#include "host/sim/cone.hpp"
#include "host/sim/elementary.hpp"

extern "C" {
#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_cycle_timers.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>
}

namespace whisker::hal::atmega1284p {
namespace {

constexpr int kCyclesPerSlice = 1600;  // 0.1 ms: an edge of each wheel at most
constexpr int kSlicesPerStep = 10;
constexpr double kSoundMmPerUs = 0.1715;  // there and back
constexpr double kAnswerUs = 450;
constexpr double kNoTargetUs = 38000;
constexpr double kInfraredHalfCone = 0.03;
constexpr int kLowestRam = 0x100;
constexpr avr_io_addr_t kExternalInterruptSense = 0x69;  // EICRA

sim::RobotSpec spec() {
  sim::RobotSpec s = sim::robot_spec(kRobotParams);
  s.period_s = 0.001;
  s.max_speed = kMotorParams.full_speed * 1e-4;
  s.max_acceleration = 4;
  return s;
}

avr_irq_t* port_irq(avr_t* avr, char port, int pin) {
  return avr_io_getirq(avr, static_cast<std::uint32_t>(AVR_IOCTL_IOPORT_GETIRQ(port)), pin);
}

void never_sleep(avr_t*, avr_cycle_count_t) {}

int index_of(std::uint8_t mask) {
  int i = 0;
  while ((mask >> i & 1) == 0) ++i;
  return i;
}

}  // namespace

/// What the emulator calls back.
struct AvrRobot::Hooks {
  struct Trigger {
    AvrRobot* robot;
    int beam;
  };
  explicit Hooks(AvrRobot& robot) : triggers{{&robot, 0}, {&robot, 1}, {&robot, 2}} {}

  static void trigger(avr_irq_t*, std::uint32_t value, void* param) {
    const auto& t = *static_cast<Trigger*>(param);
    if (value == 0) t.robot->shot(t.beam);
  }
  static void mark(avr_t* avr, avr_io_addr_t address, std::uint8_t value, void* param) {
    avr->data[address] = value;
    static_cast<AvrRobot*>(param)->mark(value);
  }
  static avr_cycle_count_t echo_begins(avr_t* avr, avr_cycle_count_t, void* param) {
    avr_raise_irq(port_irq(avr, 'B', index_of(wiring::kEcho)), 1);
    avr_cycle_timer_register_usec(avr, static_cast<std::uint32_t>(static_cast<Hooks*>(param)->echo_us),
                                  echo_ends, param);
    return 0;
  }
  static avr_cycle_count_t echo_ends(avr_t* avr, avr_cycle_count_t, void*) {
    avr_raise_irq(port_irq(avr, 'B', index_of(wiring::kEcho)), 0);
    return 0;
  }

  static avr_cycle_count_t slice(avr_t*, avr_cycle_count_t when, void* param) {
    static_cast<AvrRobot*>(param)->slice();
    return when + kCyclesPerSlice;
  }

  Trigger triggers[kBeams];
  double echo_us = 0;
};

AvrRobot::AvrRobot(const std::string& image, const sim::WorldView& world)
    : world_(world), plant_(world, spec(), {}, 1, {}), hooks_(std::make_unique<Hooks>(*this)) {
  elf_firmware_t firmware{};
  if (elf_read_firmware(image.c_str(), &firmware) != 0) throw std::runtime_error(image + ": cannot be read");
  avr_ = avr_make_mcu_by_name("atmega328p");
  if (avr_ == nullptr) throw std::runtime_error("the emulator does not know the chip");
  avr_init(avr_);
  avr_->log = LOG_NONE;
  avr_->sleep = never_sleep;
  firmware.frequency = 16000000;
  firmware.vcc = firmware.avcc = firmware.aref = 5000;
  avr_load_firmware(avr_, &firmware);
  static_ram_ = static_cast<int>(firmware.datasize + firmware.bsssize);
  // Else the emulator polls the level of PD2 and PD3 at every cycle, though their own interrupts are off.
  avr_->data[kExternalInterruptSense] = 0x05;
  avr_register_io_write(avr_, reg::kGPIOR0.address, Hooks::mark, this);
  for (Hooks::Trigger& t : hooks_->triggers) {
    avr_irq_register_notify(port_irq(avr_, 'B', index_of(wiring::kTrigger[t.beam])), Hooks::trigger, &t);
  }
  avr_cycle_timer_register(avr_, kCyclesPerSlice, Hooks::slice, this);
  see();
}

AvrRobot::~AvrRobot() { avr_terminate(avr_); }

void AvrRobot::mark(std::uint8_t value) {
  if (value == 0) {
    const std::uint64_t cycles = avr_->cycle - began_;
    if (cycles > worst_tick_) worst_tick_ = cycles;
    return;
  }
  const double period = static_cast<double>(avr_->cycle - began_);
  if (ticks_ > 0) {
    longest_period_ = std::fmax(longest_period_, period);
    shortest_period_ = std::fmin(shortest_period_, period);
  }
  began_ = avr_->cycle;
  ++ticks_;
}

double AvrRobot::distance(int beam, double half_cone_rad) const {
  const sim::Pose pose = plant_.pose();
  const double side = sim::robot_spec(kRobotParams).side_angle;
  const sim::SinCos axis = sim::sin_cos(pose.heading + side * (1 - beam));
  const sim::SinCos half = sim::sin_cos(half_cone_rad);
  return sim::range({pose.at, {axis.cos, axis.sin}, half.cos, half.sin}, world_, plant_.time(), 4.0);
}

void AvrRobot::shot(int beam) {
  if (echo_dead[beam]) return;
  const double mm = distance(beam, sim::robot_spec(kRobotParams).cone_half_width) * 1000;
  hooks_->echo_us = mm < 4000 && !infrared_only ? mm / kSoundMmPerUs : kNoTargetUs;
  avr_cycle_timer_register_usec(avr_, static_cast<std::uint32_t>(kAnswerUs), Hooks::echo_begins,
                                hooks_.get());
}

void AvrRobot::see() {
  for (int i = 0; i < kBeams; ++i) {
    const double mm = distance(i, kInfraredHalfCone) * 1000;
    const mcu::IrCurve& curve = mcu::kGp2y0a21;
    double mv = 250;
    if (mm < 1500) mv = std::fmin(3100, curve.zero_mv + curve.slope_mv_mm / std::fmax(mm, 1));
    avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + wiring::kInfraredChannel[i]),
                  static_cast<std::uint32_t>(mv));
  }
  if (echo_line_high) avr_raise_irq(port_irq(avr_, 'B', index_of(wiring::kEcho)), 1);
}

double AvrRobot::duty(int wheel) const {
  const auto reg_of = [this](Register r) { return avr_->data[r.address]; };
  const bool left = wheel == 0;
  const std::uint8_t port = reg_of(left ? reg::kPORTB : reg::kPORTC) & reg_of(left ? reg::kDDRB : reg::kDDRC);
  const bool forward = (port & (left ? wiring::kLeftForward : wiring::kRightForward)) != 0;
  const bool backward = (port & (left ? wiring::kLeftBackward : wiring::kRightBackward)) != 0;
  const bool pulses = (reg_of(reg::kTCCR0A) & (left ? bits::kCOM0A1 : bits::kCOM0B1)) != 0 &&
                      (reg_of(reg::kTCCR0A) & 3) == (bits::kWGM01 | bits::kWGM00) &&
                      (reg_of(reg::kTCCR0B) & 7) != 0 &&
                      (reg_of(reg::kDDRD) & wiring::kPulses) == wiring::kPulses;
  if (!pulses || forward == backward) return 0;
  const double high = (reg_of(left ? reg::kOCR0A : reg::kOCR0B) + 1) / 256.0;
  return forward ? high : -high;
}

/// One edge of a quadrature encoder: A leads B forward.
void AvrRobot::turn(int wheel, int direction) {
  phase_[wheel] = (phase_[wheel] + direction + 4) % 4;
  if (encoder_dead[wheel]) return;
  const bool a = phase_[wheel] == 1 || phase_[wheel] == 2;
  const bool b = phase_[wheel] >= 2;
  const int pin_a = index_of(wheel == 0 ? wiring::kLeftA : wiring::kRightA);
  const int pin_b = index_of(wheel == 0 ? wiring::kLeftB : wiring::kRightB);
  avr_raise_irq(port_irq(avr_, 'D', pin_a), a ? 1 : 0);
  avr_raise_irq(port_irq(avr_, 'D', pin_b), b ? 1 : 0);
}

void AvrRobot::step_edges() {
  for (int wheel = 0; wheel < 2; ++wheel) {
    if (edges_left_[wheel] == 0) continue;
    const int direction = edges_left_[wheel] > 0 ? 1 : -1;
    edges_left_[wheel] -= direction;
    turn(wheel, direction);
  }
}

void AvrRobot::slice() {
  step_edges();
  if (++slices_ % kSlicesPerStep == 0) move_on();
}

void AvrRobot::move_on() {
  const auto speed = [this](int wheel) {
    return static_cast<std::int16_t>(std::lround(duty(wheel) * kMotorParams.full_speed));
  };
  plant_.command({speed(0), speed(1)});
  plant_.advance();
  const EncoderCounts now = plant_.encoders();
  edges_left_[0] += mcu::counts_between(seen_.left, now.left);
  edges_left_[1] += mcu::counts_between(seen_.right, now.right);
  seen_ = now;
  see();
}

void AvrRobot::run(double seconds) {
  for (const double end = plant_.time() + seconds - 1e-9; plant_.time() < end && !crashed_;) {
    const int state = avr_run(avr_);
    const int pointer = avr_->data[R_SPL] | avr_->data[R_SPH] << 8;
    if (pointer < lowest_stack_ && pointer >= kLowestRam) lowest_stack_ = pointer;
    crashed_ = state == cpu_Crashed || state == cpu_Done;
  }
}

Fault AvrRobot::fault() const { return static_cast<Fault>(avr_->data[reg::kGPIOR1.address] & 0x0F); }
planning::Outcome AvrRobot::outcome() const {
  return static_cast<planning::Outcome>(avr_->data[reg::kGPIOR1.address] >> 4);
}
int AvrRobot::troubles() const { return avr_->data[reg::kGPIOR2.address]; }
int AvrRobot::deepest_stack() const { return avr_->ramend - lowest_stack_; }

}  // namespace whisker::hal::atmega1284p
