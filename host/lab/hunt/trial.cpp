#include "host/lab/hunt/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "firmware/apps/command_hash.hpp"
#include "firmware/math/work.hpp"
#include "host/harness/run/event_player.hpp"
#include "host/harness/run/make_record.hpp"
#include "host/harness/run/narrowest_gap.hpp"
#include "host/harness/run/runner.hpp"
#include "host/harness/run/sim_world.hpp"
#include "host/harness/run/spec.hpp"
#include "host/lab/guard/guarded_body.hpp"
#include "host/lab/hunt/attacker.hpp"
#include "host/lab/hunt/events.hpp"
#include "host/lab/hunt/geometry.hpp"
#include "host/lab/hunt/judge.hpp"
#include "host/lab/hunt/on_bus.hpp"
#include "host/lab/hunt/parts/parts.hpp"
#include "host/lab/hunt/premise.hpp"

namespace whisker::hunt {
namespace {

constexpr double kAgreement_m = 1e-4;
constexpr double kOffGoal_m = 0.002;
constexpr double kFarFromAll = 1e9;                        // of what has no place
constexpr std::uint64_t kHashesEvery = 8, kBusEvery = 32;  // missions, by seed

/// Uneven gaps between ticks, at most the longest accepted one.
class Gaps {
 public:
  Gaps(std::uint64_t seed, const Params& p)
      : random_(seed),
        uneven_(seed != 0),
        kind_(random_.index(5)),
        period_ms_(static_cast<int>(p.safety.period.raw())),
        longest_ms_(static_cast<int>(longest_gap(p).raw())) {}

  /// The ticks are late on average; the robot may then miss readings and make no progress.
  bool are_late() const {
    const int means_ms[] = {longest_ms_ / 2, longest_ms_, (9 * period_ms_ + longest_ms_) / 10,
                            longest_ms_ / 2, 0};
    return uneven_ && means_ms[kind_] * 4 > period_ms_ * 5;
  }

  int next_ms() {
    if (!uneven_) return period_ms_;
    switch (kind_) {
      case 0: return 1 + random_.index(longest_ms_);
      case 1: return longest_ms_;
      case 2: return random_.chance(0.1) ? longest_ms_ : period_ms_;
      case 3: return random_.chance(0.5) ? 1 : longest_ms_;
      default: return std::min(longest_ms_, std::max(1, period_ms_ + random_.index(5) - 2));
    }
  }

 private:
  worlds::Random random_;
  bool uneven_;
  int kind_;
  int period_ms_, longest_ms_;
};

/// A robot that somebody drives, and the events of its scenario.
class Driven {
 public:
  Driven(const Scenario& scenario, bool is_mission)
      : scenario_(scenario), events_(scenario.events), is_mission_(is_mission) {
    for (const Params& robot : robots_of(scenario)) free_m_ = std::max(free_m_, free_at_start_m(robot));
  }
  virtual ~Driven() = default;
  virtual const sim::Plant& plant() const = 0;
  /// False: the drive is over.
  virtual bool tick() = 0;
  virtual void pass(int ms) = 0;
  virtual void tell(Outcome& outcome) = 0;
  const Goal& goal() const { return scenario_.goal; }
  /// An event put the robot down where the ground around it was not free.
  bool is_outside_premise() const { return outside_; }

 protected:
  template <class Body>
  void play(Body& body) {
    while (body.hears()) {
      const Event* const event = events_.next(plant().time());
      if (event == nullptr) break;
      if (event->kind == EventKind::goal) scenario_.goal = event->goal;
      put_down_ = put_down_ || puts_down(event->kind);
      body.play(*event);
    }
    const bool stands = plant().v_left() == 0 && plant().v_right() == 0;
    if (!put_down_ || !(stands || body.hears())) return;
    outside_ = outside_ || nearest(scenario_, plant().pose().at).distance_m < free_m_;
    put_down_ = !stands;
  }
  bool to_come(std::initializer_list<EventKind> kinds) const {
    return events_.to_come(kinds, scenario_.time_limit_s);
  }

  Scenario scenario_;  // its goal follows the events
  EventPlayer events_;

 private:
  /// New parameters wait for a start, which a goal gives to a mission.
  bool puts_down(EventKind kind) {
    waiting_ = waiting_ || kind == EventKind::param || kind == EventKind::table;
    const bool starts = kind == EventKind::restart || (kind == EventKind::goal && waiting_ && is_mission_);
    if (starts) waiting_ = false;
    return starts || kind == EventKind::place;
  }

  bool is_mission_;
  bool waiting_ = false;
  double free_m_ = 0;
  bool put_down_ = false;
  bool outside_ = false;
};

class GuardDrive final : public Driven {
 public:
  GuardDrive(Case& c)
      : Driven(c.scenario, false),
        case_(c),
        world_(scenario_),
        body_(scenario_, world_.view(), {true, c.scenario.robot.guard, 0, nullptr}, c.gaps != 0),
        attacker_(c.scenario, c.attacker),
        recorded_(c.commands),
        hand_(c.commands.empty() ? static_cast<guard::Operator&>(attacker_) : recorded_),
        next_s_(hand_.first_s()) {}

  const sim::Plant& plant() const override { return body_.plant(); }
  bool tick() override {
    if (!events_.empty()) play(body_);
    if (plant().time() >= scenario_.time_limit_s || is_over()) return false;
    if (plant().time() >= next_s_) {
      const guard::Twist twist = hand_.ask({plant().pose(), plant().time()});
      if (body_.hears()) body_.command(twist);
      next_s_ = plant().time() + hand_.pause_s();
    }
    body_.tick();
    states_.insert(name(body_.status().reason));
    return true;
  }
  void pass(int ms) override { body_.pass(ms); }
  void tell(Outcome& o) override {
    const Fault fault = body_.status().health.fault;
    o.end = fault == Fault::none ? "time" : fmt::format("fault {}", name(fault));
    o.hash = body_.hash();
    o.states = states_;
    if (case_.commands.empty()) case_.commands = attacker_.commands();
  }

 private:
  bool is_over() const {
    return body_.faulted() && body_.stands() && body_.hears() &&
           !to_come({EventKind::reset, EventKind::restart});
  }

  Case& case_;
  SimWorld world_;
  guard::GuardedBody body_;
  Attacker attacker_;
  guard::Recorded recorded_;
  guard::Operator& hand_;
  double next_s_;
  std::set<std::string> states_;
};

sim::RobotSpec spec_of(const Case& c) {
  sim::RobotSpec spec = robot_spec(c.scenario);
  if (c.gaps != 0) spec.period_s = 0.001;
  return spec;
}

class MissionDrive final : public Driven {
 public:
  explicit MissionDrive(const Case& c)
      : Driven(c.scenario, true),
        fine_(c.gaps != 0),
        world_(scenario_),
        plant_(world_.view(), spec_of(c), noise_spec(scenario_.noise), scenario_.seed, scenario_.start),
        pilot_(core_pilot(scenario_, *c.planner, plant_)) {}

  const sim::Plant& plant() const override { return plant_; }
  bool tick() override {
    if (!events_.empty()) play(*pilot_);
    const bool waits =
        !events_.empty() && (!pilot_->hears() || to_come({EventKind::goal, EventKind::restart}));
    const Status& status = pilot_->tick(Time::from_raw(now_ms_));
    status_ = &status;
    hash_.add(status.command);
    // A restart begins a new robot's count.
    work_ = std::max(work_, int{status.work});
    states_.insert(
        fmt::format("{}/{}", planning::name(status.decision.mode), planning::name(status.decision.why)));
    if (!waits && has_ended(status)) return false;
    const auto next_ms = static_cast<double>(now_ms_) + scenario_.robot.safety.period.raw();
    return next_ms / 1000 <= scenario_.time_limit_s;
  }
  void pass(int ms) override {
    now_ms_ += static_cast<std::uint32_t>(ms);
    if (!fine_) return plant_.advance();
    for (int i = 0; i < ms && !plant_.in_contact(); ++i) plant_.advance();
  }
  void tell(Outcome& o) override {
    if (status_ == nullptr) return;  // in contact from the start
    const auto verdict = verdict_of(status_->decision.outcome);
    const char* const why = planning::name(status_->decision.why);
    o.end = status_->health.fault != Fault::none ? fmt::format("fault {}", name(status_->health.fault))
            : verdict == Verdict::reached        ? "reached"
            : verdict == Verdict::unreachable    ? "unreachable"
            : verdict                            ? fmt::format("gave_up {}", why)
                                                 : "time";
    o.hash = hash_.value();
    o.states = states_;
    o.work = work_;
  }

 private:
  /// As MissionRun does.
  bool has_ended(const Status& status) const {
    const bool stands = status.command.left == 0 && status.command.right == 0;
    if (status.health.fault != Fault::none) return stands;
    if (verdict_of(status.decision.outcome)) return true;
    return !events_.empty() && stands && status.decision.outcome == planning::Outcome::none;
  }

  bool fine_;
  SimWorld world_;
  sim::Plant plant_;
  std::unique_ptr<Pilot> pilot_;
  const Status* status_ = nullptr;
  std::uint32_t now_ms_ = 0;
  int work_ = 0;
  CommandHash hash_;
  std::set<std::string> states_;
};

/// No dropouts, fixes or events excuse a fault.
bool is_exact(const Scenario& s) {
  return s.noise.fix_every_m == 0 && s.noise.range_dropout == 0 && s.events.empty();
}

bool ticks_in_time(const Case& c) { return !Gaps(c.gaps, c.scenario.robot).are_late(); }

bool has_promised_way(const Scenario& s) { return has_way(s, narrowest_gap_m(s.robot) / 2 * 1.01); }

/// Of a drive without contact that ended: as it should not with declared sensors, drive and ticks.
bool is_wrong(const Case& c, const std::string& end, double left_m, double path_m) {
  const Scenario& s = c.scenario;
  if (end == "gave_up length_budget") return path_m < metres(s.robot.boundary.length_budget) - kOffGoal_m;
  const double allowed = s.goal.tolerance_m * 1.05 + kOffGoal_m + 1.0 / s.robot.wheels.counts_per_metre;
  if (end == "reached") return left_m > allowed;
  if (end == "fault range_untrusted") return senses_as_declared(s);
  const bool by_late_ticks =
      end == "fault range_lost" || end == "fault range_unsteady" || end == "fault no_progress";
  if (by_late_ticks) return ticks_in_time(c);
  const bool gives_up = end == "unreachable" || end.rfind("gave_up", 0) == 0;
  if (gives_up) return ticks_in_time(c) && has_promised_way(s);
  return end.rfind("fault", 0) == 0;
}

std::string other_hash(const Case& c, std::uint64_t hash) {
  if (!c.planner || c.gaps != 0 || c.scenario.seed % kHashesEvery != 0) return "";
  RunOptions options;
  options.planner = *c.planner;
  if (run(c.scenario, options).hash != hash) return "other_hash";
  if (c.scenario.seed % kBusEvery != 0 || !drives_alike_on_the_bus(c.scenario)) return "";
  return differs_on_bus(c.scenario, *c.planner, hash);
}

std::unique_ptr<Driven> make_driven(Case& c) {
  if (c.planner) return std::make_unique<MissionDrive>(c);
  return std::make_unique<GuardDrive>(c);
}

void drive(Driven& driven, Gaps gaps, bool fine, Judge& judge) {
  const sim::Plant& plant = driven.plant();
  while (!plant.in_contact() && !judge.touched() && driven.tick()) {
    const int gap = gaps.next_ms();
    for (int done = 0; done < gap; done += fine ? 1 : gap) {
      driven.pass(fine ? 1 : gap);
      judge.see(plant.pose(), plant.time());
    }
  }
}

Outcome attempt_part(const Case& c) {
  Outcome o;
  o.end = "judged";
  o.gap_m = o.closeness = kFarFromAll;
  const std::string wrong = judge_part(c.part, c.attacker);
  if (!wrong.empty()) o.finding = fmt::format("part {}: {}", c.part, wrong);
  return o;
}

}  // namespace

Outcome attempt(Case& c) {
  if (!c.part.empty()) return attempt_part(c);
  const Scenario& s = c.scenario;
  const auto driven = make_driven(c);
  const sim::Plant& plant = driven->plant();
  Judge judge(s);
  drive(*driven, {c.gaps, s.robot}, c.gaps != 0, judge);
  Outcome o;
  driven->tell(o);
  o.time_s = plant.in_contact() ? plant.contact_time() : plant.time();
  o.path_m = plant.path_length();
  o.gap_m = judge.gap_m();
  o.closeness = judge.closeness();
  if (driven->is_outside_premise()) return o;
  if (plant.in_contact() || judge.touched()) {
    o.end = "contact";
    const bool agree = plant.in_contact() && judge.gap_m() < kAgreement_m;
    o.finding = agree ? "contact" : "judges_disagree";
    return o;
  }
  const double left_m = length(driven->goal().at - plant.pose().at);
  if (is_exact(s) && is_wrong(c, o.end, left_m, o.path_m))
    o.finding = o.end == "reached" ? "off_goal" : o.end;
  const bool rests = o.end == "time" && c.planner && judge.rests(o.time_s);
  if (rests && is_exact(s) && ticks_in_time(c)) o.finding = "stuck";
  if (o.finding.empty() && o.work > Work::kMost) o.finding = "work";
  if (o.finding.empty()) o.finding = other_hash(c, o.hash);
  return o;
}

}  // namespace whisker::hunt
