// Drives 2 m ahead among obstacles: three HC-SR04, two motors with quadrature encoders behind an H-bridge.
// Set your pins, and the parameters of your robot. It needs 20 KB of RAM.
#include <whisker.hpp>

using namespace whisker;

constexpr uint8_t kTrigger[] = {22, 24, 26};  // left, front, right
constexpr uint8_t kEcho[] = {2, 3, 21};       // with interrupts
constexpr uint8_t kEncoderA[] = {18, 19};     // with interrupts; left, right
constexpr uint8_t kEncoderB[] = {30, 31};
constexpr uint8_t kPwm[] = {5, 6};
constexpr uint8_t kForward[] = {32, 34};
constexpr uint8_t kBackward[] = {33, 35};

constexpr Params my_robot() {
  Params p;
  p.body.radius = 90_mm;
  p.body.track = 140_mm;
  p.wheels.counts_per_metre = 5000;
  p.rangefinders.side_angle = Angle::turns(375, 3600);
  p.rangefinders.cone = 36_deg;
  p.rangefinders.clear_range = 600_mm;
  p.rangefinders.rate_hz = 20;
  p.rangefinders.latency = 50_ms;
  p.rangefinders.incidence = 40_deg;
  p.conditioning.stale_after = 250_ms;
  return p;
}
static_assert(check(my_robot()) == ParamFault::none, "the parameters do not fit: ask `whisker robot check`");

enum Line : uint8_t { kSilent, kHigh, kEnded };
volatile Line echo[3];                            // since the trigger
volatile uint32_t echo_began[3], echo_ended[3];  // us
volatile int32_t counted[2];

template <int kBeam>
void on_echo() {
  const uint32_t now = micros();
  const bool high = digitalRead(kEcho[kBeam]) == HIGH;
  if (high && echo[kBeam] == kSilent) {
    echo_began[kBeam] = now;
    echo[kBeam] = kHigh;
  } else if (!high && echo[kBeam] == kHigh) {
    echo_ended[kBeam] = now;
    echo[kBeam] = kEnded;
  }
}

template <int kWheel>
void on_count() {
  const bool same = digitalRead(kEncoderA[kWheel]) == digitalRead(kEncoderB[kWheel]);
  counted[kWheel] = counted[kWheel] + (same ? 1 : -1);
}

// One sensor after another, so that none hears the ping of another. An HC-SR04 raises its echo line within 0.5
// ms of the trigger, and lowers it when the echo returns or after 38 ms. A line that does not rise in time is
// that of a sensor that is dead, unplugged or locked up, and proves nothing.
class Sonars final : public hal::Rangefinders {
 public:
  void poll() {
    if (millis() - pinged_ms_ < 17) return;
    take(active_);
    active_ = (active_ + 1) % hal::kBeams;
    echo[active_] = kSilent;
    digitalWrite(kTrigger[active_], HIGH);
    delayMicroseconds(10);
    digitalWrite(kTrigger[active_], LOW);
    triggered_us_ = micros();
    pinged_ms_ = millis();
  }
  bool read(hal::RangeReadings& out) noexcept override {
    for (int i = 0; i < hal::kBeams; ++i) {
      out.beam[i] = latest_[i];
      const uint32_t age = millis() - measured_ms_[i];
      out.beam[i].age_ms = static_cast<uint8_t>(age < 255 ? age : 255);
    }
    return true;
  }

 private:
  void take(int beam) {
    noInterrupts();
    const Line line = echo[beam];
    const uint32_t began = echo_began[beam], ended = echo_ended[beam];
    interrupts();
    const bool answered = line != kSilent && began - triggered_us_ < kAnswersWithinUs;
    hal::RangeReading& reading = latest_[beam];
    reading.status = hal::RangeStatus::invalid;
    if (answered) reading.status = line == kEnded ? hal::RangeStatus::ok : hal::RangeStatus::clear;
    reading.mm = static_cast<uint16_t>((ended - began) * 17 / 100);  // there and back at 340 m/s
    reading.sequence = static_cast<uint8_t>((reading.sequence + 1) % 16);
    measured_ms_[beam] = pinged_ms_;
  }

  static constexpr uint32_t kAnswersWithinUs = 1000;
  static constexpr hal::RangeReading kNone{0, hal::RangeStatus::stale, 255, 0};
  hal::RangeReading latest_[hal::kBeams] = {kNone, kNone, kNone};
  uint32_t measured_ms_[hal::kBeams] = {};
  uint32_t pinged_ms_ = 0;
  uint32_t triggered_us_ = 0;
  int active_ = 0;
};

struct Encoders {
  bool read(hal::EncoderCounts& out) noexcept {
    noInterrupts();
    const int32_t left = counted[0], right = counted[1];
    interrupts();
    out.left = static_cast<uint32_t>(left) % hal::kEncoderModulus;
    out.right = static_cast<uint32_t>(right) % hal::kEncoderModulus;
    return true;
  }
};

struct Motors {
  void drive(int16_t left, int16_t right) noexcept {
    drive_one(0, left);
    drive_one(1, right);
  }
  void drive_one(int wheel, int16_t duty) noexcept {
    digitalWrite(kForward[wheel], duty > 0 ? HIGH : LOW);
    digitalWrite(kBackward[wheel], duty < 0 ? HIGH : LOW);
    analogWrite(kPwm[wheel], (duty < 0 ? -int32_t{duty} : int32_t{duty}) / 128);
  }
};

struct Timer final : hal::Clock {
  uint32_t now_ms() noexcept override { return millis(); }
};

constexpr Params kRobot = my_robot();
constexpr hal::mcu::MotorParams kMotor{4000, 5000, 5, 100000};  // 0.4 m/s at full duty

Sonars sonars;
Encoders encoders;
Motors motors;
Timer timer;
hal::mcu::GovernedWheels<Motors, Encoders> wheels{kMotor, kMotor, motors, encoders, timer};
planning::TableBoundaryPlanner boundary{kRobot, fuzzy::kDefaultTable};
Robot robot{sonars, wheels, boundary.planner, kRobot};
uint32_t next_ms;

void setup() {
  Serial.begin(115200);
  for (int i = 0; i < 3; ++i) {
    pinMode(kTrigger[i], OUTPUT);
    pinMode(kEcho[i], INPUT_PULLUP);  // so that an unplugged sensor has a steady line
  }
  for (int i = 0; i < 2; ++i) {
    pinMode(kEncoderA[i], INPUT_PULLUP);
    pinMode(kEncoderB[i], INPUT_PULLUP);
    pinMode(kPwm[i], OUTPUT);
    pinMode(kForward[i], OUTPUT);
    pinMode(kBackward[i], OUTPUT);
  }
  attachInterrupt(digitalPinToInterrupt(kEcho[0]), on_echo<0>, CHANGE);
  attachInterrupt(digitalPinToInterrupt(kEcho[1]), on_echo<1>, CHANGE);
  attachInterrupt(digitalPinToInterrupt(kEcho[2]), on_echo<2>, CHANGE);
  attachInterrupt(digitalPinToInterrupt(kEncoderA[0]), on_count<0>, CHANGE);
  attachInterrupt(digitalPinToInterrupt(kEncoderA[1]), on_count<1>, CHANGE);
  robot.place({{0_m, 0_m}, 0_deg});
  robot.set_goal({{2_m, 0_m}, 100_mm});
  next_ms = millis();
}

void loop() {
  sonars.poll();
  if (static_cast<int32_t>(millis() - next_ms) < 0) return;
  next_ms += 10;
  static planning::Why told = planning::Why::none;
  const Status& status = robot.tick(Time::from_raw(millis()));
  if (status.decision.why == told) return;
  told = status.decision.why;
  Serial.print(planning::name(status.decision.mode));
  Serial.print(": ");
  Serial.println(status.health.fault == Fault::none ? planning::name(told) : name(status.health.fault));
}
