#include "host/guard/operators.hpp"

#include <cmath>
#include <utility>

#include "host/guard/path_follower.hpp"
#include "host/worlds/random.hpp"

namespace whisker::guard {
namespace {

constexpr double kPerfectMargin_m = 0.1;
constexpr double kSloppyMargin_m = 0.03;
constexpr double kHandError_m = 0.06;

/// About a standard normal deviate.
double deviate(worlds::Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform(0, 1);
  return sum;
}

/// Looks two radii ahead, and its target wanders: the correlation time of the error is three seconds.
class Sloppy final : public PathFollower {
 public:
  Sloppy(std::vector<sim::Vec2> path, const Scenario& s, std::uint64_t seed)
      : PathFollower(std::move(path), s.robot.body.radius.raw() * 2e-6, limits_of(s)), random_(seed) {}

 private:
  sim::Vec2 off(sim::Vec2 target, const Sight& sight) override {
    const double decay = std::exp(-(sight.t_s - last_s_) / 3);
    last_s_ = sight.t_s;
    const double fresh = std::sqrt(1 - decay * decay);
    error_ = {error_.x * decay + fresh * deviate(random_), error_.y * decay + fresh * deviate(random_)};
    return target + error_ * kHandError_m;
  }

  worlds::Random random_;
  sim::Vec2 error_;
  double last_s_ = -10;
};

class Joystick final : public Operator {
 public:
  Joystick(const Scenario& s, std::uint64_t seed) : limits_(limits_of(s)), random_(seed) {}
  Twist ask(const Sight& sight) override {
    if (sight.t_s >= until_s_) {
      until_s_ = sight.t_s + random_.uniform(0.3, 2);
      const bool turns = random_.chance(0.6);
      twist_ = {limits_.speed_mps * (random_.chance(0.8) ? 1 : random_.uniform(-0.5, 0.5)),
                turns ? random_.uniform(-1, 1) : 0};
    }
    return twist_;
  }

 private:
  Limits limits_;
  worlds::Random random_;
  double until_s_ = 0;
  Twist twist_;
};

class Hostile final : public Operator {
 public:
  Hostile(const Scenario& s, std::uint64_t seed) : limits_(limits_of(s)), random_(seed) {}

  Twist ask(const Sight& sight) override {
    if (sight.t_s >= until_s_) plot(sight.t_s);
    switch (plot_) {
      case Plot::steady: break;
      case Plot::zigzag: twist_.turning_radps = -twist_.turning_radps; break;
      case Plot::shake: twist_.forward_mps = -twist_.forward_mps; break;
      case Plot::noise: draw(); break;
      case Plot::beyond: twist_ = {random_.uniform(-2000, 2000), random_.uniform(-2000, 2000)}; break;
      case Plot::pirouette: twist_.forward_mps = random_.chance(0.5) ? 0 : twist_.forward_mps; break;
    }
    return twist_;
  }
  double pause_s() override { return random_.uniform(shortest_s_, longest_s_); }

 private:
  enum class Plot { steady, zigzag, shake, noise, beyond, pirouette };

  void draw() {
    const double forward[] = {1, 1, 1, 0.5, 0.05, 0.003, -1, random_.uniform(-1.5, 1.5)};
    twist_.forward_mps = limits_.speed_mps * forward[random_.index(8)];
    twist_.turning_radps = random_.chance(0.4) ? 0 : limits_.turn_radps * random_.uniform(-1.2, 1.2);
    if (random_.chance(0.3)) twist_.turning_radps *= 0.2;
  }
  void plot(double t_s) {
    until_s_ = t_s + random_.uniform(0.02, random_.chance(0.3) ? 6 : 1.5);
    plot_ = static_cast<Plot>(random_.chance(0.5) ? 0 : random_.index(6));
    draw();
    shortest_s_ = random_.uniform(0.001, 0.05);
    longest_s_ = shortest_s_ + (random_.chance(0.2) ? random_.uniform(0, 0.6) : random_.uniform(0, 0.05));
  }

  Limits limits_;
  worlds::Random random_;
  Plot plot_ = Plot::steady;
  double until_s_ = 0;
  double shortest_s_ = 0.02, longest_s_ = 0.02;
  Twist twist_;
};

/// A bow to one side whose height is a share of the distance.
std::vector<sim::Vec2> bow(const Scenario& s, worlds::Random& random) {
  const double height = random.uniform(-0.25, 0.25);
  const sim::Vec2 way = s.goal.at - s.start.at, side{-way.y, way.x};
  const int steps = static_cast<int>(std::hypot(way.x, way.y) * 100) + 1;
  std::vector<sim::Vec2> path;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    path.push_back(s.start.at + way * t + side * (height * 4 * t * (1 - t)));
  }
  return path;
}

}  // namespace

const char* name(Hand hand) {
  switch (hand) {
    case Hand::perfect: return "perfect";
    case Hand::sloppy: return "sloppy";
    case Hand::blind: return "blind";
    case Hand::joystick: return "joystick";
    case Hand::hostile: return "hostile";
  }
  return "?";
}

std::optional<Hand> hand_named(std::string_view text) {
  for (const Hand hand : kHands) {
    if (text == name(hand)) return hand;
  }
  return std::nullopt;
}

std::unique_ptr<Operator> make_operator(Hand hand, const Scenario& s, std::uint64_t seed) {
  worlds::Random random(seed);
  const double radius = s.robot.body.radius.raw() * 1e-6;
  switch (hand) {
    case Hand::perfect:
    case Hand::sloppy: {
      auto path = path_with_margin(s, hand == Hand::perfect ? kPerfectMargin_m : kSloppyMargin_m);
      if (!path) return nullptr;
      if (hand == Hand::perfect) {
        return std::make_unique<PathFollower>(std::move(*path), radius, limits_of(s));
      }
      return std::make_unique<Sloppy>(std::move(*path), s, random.bits());
    }
    case Hand::blind: return std::make_unique<PathFollower>(bow(s, random), radius, limits_of(s));
    case Hand::joystick: return std::make_unique<Joystick>(s, random.bits());
    case Hand::hostile: return std::make_unique<Hostile>(s, random.bits());
  }
  return nullptr;
}

}  // namespace whisker::guard
