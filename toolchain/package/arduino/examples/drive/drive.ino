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
  p.rangefinders.rate_hz = 16;
  p.rangefinders.latency = 50_ms;
  p.rangefinders.incidence = 40_deg;
  p.conditioning.stale_after = 250_ms;
  return p;
}
static_assert(check(my_robot()) == ParamFault::none, "the parameters do not fit: ask `whisker robot check`");

hal::mcu::Sonars sonars;
volatile int32_t counted[2];

template <int kBeam>
void on_echo() {
  sonars.on_edge(kBeam, digitalRead(kEcho[kBeam]) == HIGH, micros());
}

template <int kWheel>
void on_count() {
  const bool same = digitalRead(kEncoderA[kWheel]) == digitalRead(kEncoderB[kWheel]);
  counted[kWheel] = counted[kWheel] + (same ? 1 : -1);
}

void ping(int beam) {
  if (beam == hal::mcu::Sonars::kNone) return;
  digitalWrite(kTrigger[beam], HIGH);
  delayMicroseconds(10);
  digitalWrite(kTrigger[beam], LOW);
}

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
  ping(sonars.take_turn(micros()));
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
