// What a beam's conditioner makes of its readings, against a list of all of them.
#include <algorithm>
#include <cmath>

#include "firmware/perception/range_conditioner.hpp"
#include "host/lab/hunt/parts/clutter.hpp"
#include "host/lab/hunt/parts/parts.hpp"

namespace whisker::hunt {
namespace {

using hal::RangeStatus;
using perception::BeamConditioner;
using perception::Echo;
using perception::Validity;

struct Measured {
  std::int32_t um;
  std::int32_t taken_ms;
};

/// The plain list.
class Beam {
 public:
  Beam(Dice& dice, const Params& p, int beam) : dice_(dice), p_(p), number_(beam), core_(beam) {
    most_ = p.rangefinders.max_range.raw();
    least_ = p.rangefinders.min_range.raw();
    core_.reset(Time::from_raw(0));
  }

  std::string tick(int elapsed_ms) {
    now_ms_ += elapsed_ms;
    arrived_ = false;
    const bool missed = dice_.chance(0.05);
    const hal::RangeReading r = draw();
    if (missed) {
      core_.miss(now(), p_, health_);
    } else {
      core_.update(r, now(), {}, p_, health_);
      take(r);
    }
    if (now_ms_ - new_ms_ > p_.conditioning.stale_after.raw()) {
      stale_ += latest_.validity == Validity::stale ? 0U : 1U;
      latest_ = {Length{}, Validity::stale};
    }
    return judge();
  }

 private:
  Time now() const { return Time::from_raw(static_cast<std::uint32_t>(now_ms_)); }

  hal::RangeReading draw() {
    if (dice_.chance(0.02)) target_mm_ = dice_.index(most_ / 1000 + 200);
    hal::RangeReading r{};
    r.mm =
        static_cast<std::uint16_t>(std::max(0, target_mm_ + (dice_.chance(0.5) ? dice_.index(31) - 15 : 0)));
    r.status = dice_.chance(0.9) ? RangeStatus::ok : static_cast<RangeStatus>(dice_.index(7));
    if (dice_.chance(0.03)) r.mm = static_cast<std::uint16_t>(65533 + dice_.index(3));
    if (dice_.chance(0.03))
      r.mm = static_cast<std::uint16_t>((dice_.chance(0.5) ? most_ : least_) / 1000 + dice_.index(3) - 1);
    r.age_ms = static_cast<std::uint8_t>(dice_.chance(0.02) ? 255 : dice_.index(60));
    sequence_ = static_cast<std::uint8_t>((sequence_ + (dice_.chance(0.8) ? 1 : 0)) % 16);
    r.sequence = sequence_;
    return r;
  }

  void take(const hal::RangeReading& r) {
    if (r.sequence == last_sequence_ || r.status == RangeStatus::stale || r.age_ms == 255) return;
    last_sequence_ = r.sequence;
    new_ms_ = now_ms_;
    const std::int64_t um = std::int64_t{r.mm} * 1000;
    Validity v = Validity::invalid;
    if (r.status == RangeStatus::ok && r.mm <= hal::kMostMm) {
      v = um >= most_ ? Validity::clear : um < least_ || um == 0 ? Validity::too_near : Validity::ok;
      if (um - 1000 >= most_ || um < least_) ++beyond_;
    }
    if (r.status == RangeStatus::clear) v = Validity::clear;
    if (r.status == RangeStatus::too_near) v = Validity::too_near;
    if (v == Validity::invalid) ++invalid_;
    const auto at = static_cast<std::int32_t>(v == Validity::ok ? um : v == Validity::clear ? most_ : 0);
    latest_ = {Length::from_raw(at), v};
    if (v == Validity::invalid) return;
    arrived_ = true;
    usable_ms_ = now_ms_;
    all_.push_back({at, now_ms_ - r.age_ms});
  }

  Echo echo(std::int32_t um) const {
    return {Length::from_raw(um), um == 0       ? Validity::too_near
                                  : um == most_ ? Validity::clear
                                                : Validity::ok};
  }
  static bool same(const Echo& a, const Echo& b) {
    return a.distance == b.distance && a.validity == b.validity;
  }
  std::int32_t back(std::size_t n) const { return all_[all_.size() - 1 - n].um; }

  std::string judge() const {
    if (!same(core_.latest(), latest_)) return "another latest reading";
    if (core_.lost_for(now()).raw() != now_ms_ - usable_ms_) return "lost for another time";
    if (health_.range_invalid != invalid_ || health_.range_out_of_range != beyond_ ||
        health_.range_stale != stale_) {
      return "other counters of readings";
    }
    const std::string wrong = judge_look();
    return wrong.empty() ? judge_sight() : wrong;
  }

  std::string judge_look() const {
    const std::int32_t since = now_ms_ - dice_.index(200);
    const auto wanted = std::size_t{derived::kConsensusReads};
    Echo due{};
    if (all_.size() >= wanted) {
      std::vector<std::int32_t> last;
      bool recent = true;
      for (std::size_t i = 0; i < wanted; ++i) {
        last.push_back(back(i));
        recent = recent && all_[all_.size() - 1 - i].taken_ms >= since;
      }
      std::sort(last.begin(), last.end());
      const bool median = p_.conditioning.consensus == Consensus::median;
      const bool agree = last.back() - last.front() <= derived::kConsensusTolerance.raw();
      if (recent && (median || agree)) due = echo(median ? last[(wanted - 1) / 2] : last.front());
    }
    const Echo looked = core_.look(Time::from_raw(static_cast<std::uint32_t>(since)), p_);
    return same(looked, due) ? "" : "another consensus";
  }

  std::string judge_sight() const {
    const perception::RecentReadings s = core_.sight(p_);
    if (all_.size() < 4) return s.fresh ? "fresh without readings" : "";
    std::int32_t three[] = {back(0), back(1), back(2)};
    const std::int32_t bend = std::abs(three[0] - 2 * three[1] + three[2]);
    std::sort(three, three + 3);
    const bool plain = !s.phantoms && !s.misses;
    if (plain && !same(s.typical, echo(three[1]))) return "the typical one is another one";
    if (plain && s.fresh != arrived_) return "fresh or not";
    if (!s.fresh) return "";
    if (s.taken.raw() != static_cast<std::uint32_t>(all_.back().taken_ms)) return "taken at another time";
    if (s.oldest.raw() != static_cast<std::uint32_t>(all_[all_.size() - 4].taken_ms))
      return "the oldest is another one";
    if (!same(s.newest, echo(back(0)))) return "the newest is another one";
    if (s.bend.raw() != bend) return "another bend";
    if (s.farthest.raw() != three[2]) return "the farthest is another one";
    if (!plain) return "";
    if (s.measured != (three[0] > 0 && three[2] < most_)) return "measured or not";
    const std::int32_t nearest = std::min(three[0], back(3));
    if (!same(s.near, echo(nearest))) return "the nearest is another one";
    return s.single == (back(0) == most_) ? "" : "alone or not";
  }

  Dice& dice_;
  const Params& p_;
  int number_;
  BeamConditioner core_;
  Health health_;
  std::int32_t most_, least_;
  std::int32_t now_ms_ = 0, new_ms_ = 0, usable_ms_ = 0, target_mm_ = 500;
  std::uint8_t sequence_ = 0, last_sequence_ = 0xFF;
  bool arrived_ = false;
  Echo latest_{};
  std::uint32_t invalid_ = 0, beyond_ = 0, stale_ = 0;
  std::vector<Measured> all_;
};

/// A beam that sees this, or something else with this probability.
struct Stream {
  Params p;
  Health health;
  BeamConditioner core;
  Time now;
  std::uint8_t sequence = 0;
  bool latest_is(Validity v) const { return core.latest().validity == v; }
  void see(RangeStatus status, int mm, const Pose& body = {}) {
    now = now + 20_ms;
    sequence = static_cast<std::uint8_t>((sequence + 1) % 16);
    core.update({static_cast<std::uint16_t>(mm), status, 20, sequence}, now, body, p, health);
  }
};

std::string judge_shares(Dice& dice) {
  const double share = dice.chance(0.3) ? 0 : dice.uniform(0.2, 0.3);
  Stream phantoms, misses;
  for (int i = 0; i < 600; ++i) {
    const bool phantom = dice.chance(share), miss = dice.chance(share);
    phantoms.see(phantom ? RangeStatus::ok : RangeStatus::clear, 100 + dice.index(350));
    misses.see(miss ? RangeStatus::clear : RangeStatus::ok, 400);
  }
  const auto seen = [&](const Stream& s) { return s.core.sight(s.p); };
  if (share == 0 && (seen(phantoms).phantoms || seen(misses).misses)) return "phantoms or misses of nothing";
  // Far above what is few.
  const bool many = share > 0.28;
  if (seen(phantoms).misses || (many && !seen(phantoms).phantoms)) return "other phantoms";
  const double measured = phantoms.core.phantom_share() / 65536.0,
               false_clear = misses.core.false_clear_share() / 65536.0;
  // A reading counts as single only between others that differ from it.
  if (share == 0 && (measured > 0.001 || false_clear > 0.001)) return "shares of nothing";
  if (share > 0 && (measured < 0.04 || measured > 0.6 || false_clear < 0.06 || false_clear > 0.5))
    return "other shares";
  if (!seen(phantoms).phantoms) return "";
  // An object counts from the fourth reading on and is clear in none.
  for (int i = 0; i < 4; ++i) {
    phantoms.see(RangeStatus::ok, 400);
    if (i > 0 && seen(phantoms).fresh && seen(phantoms).near.validity == Validity::clear)
      return "an object is cleared away";
  }
  return seen(phantoms).fresh && seen(phantoms).near.distance <= 400_mm ? "" : "an object is a phantom";
}

/// Round a pillar at the same distance all the time.
std::string judge_circle(Dice& dice) {
  Stream s;
  const int way = dice.chance(0.5) ? 3 : -3;
  const Length radius = millimetres(100 + dice.index(1500));
  const auto at = [&](int deg) {
    const Angle heading = Angle::turns(deg, 360);
    return Pose{polar(heading - 90_deg, radius), heading};
  };
  for (int i = 0; i < 300; ++i) s.see(RangeStatus::ok, 700, at(i * way % 360));
  if (s.health.range_stuck > 0) return "stuck on a circle";
  // By the tangent.
  const Pose left = at(300 * way % 360);
  const double out = metres(radius) + 0.4;
  for (double on = 0; on < 2 * out; on += 0.01) {
    const Pose body{left.at + polar(left.heading, micrometres(static_cast<std::int32_t>(on * 1e6))),
                    left.heading};
    s.see(RangeStatus::ok, 700, body);
  }
  return s.latest_is(Validity::stuck) ? "" : "a stuck beam leaves a circle unnoticed";
}

/// Repeats over a turn and a way that leaves it.
std::string judge_stuck(Dice& dice) {
  Stream s;
  const int mm = 100 + dice.index(1500);
  const Vec at{millimetres(dice.index(2000) - 1000), millimetres(dice.index(2000) - 1000)};
  const Angle from = draw_angle(dice);
  const double most_deg = static_cast<double>(derived::kStuckTurn.raw()) * 360 / 4294967296.0;
  const double turned_deg = dice.chance(0.5) ? most_deg - 4 : most_deg + 4;
  Pose body{at, from};
  for (double deg = 0; deg <= turned_deg; deg += 2) {
    body.heading = from + Angle::turns(static_cast<int>(deg), 360);
    s.see(RangeStatus::ok, mm, body);
  }
  if (s.health.range_stuck > 0) return "stuck in a round room";
  const Angle way = body.heading;
  for (int step = 0; step < 60; ++step) {
    body.at = at + polar(way, millimetres(step));
    s.see(RangeStatus::ok, mm, body);
    const bool stuck = s.core.latest().validity == Validity::stuck;
    if (stuck && (turned_deg < most_deg || step < 18)) return "stuck too soon";
    if (step > 30 && turned_deg > most_deg && !stuck) return "a stuck beam is not noticed";
  }
  s.see(RangeStatus::ok, mm + 1, body);
  return s.core.latest().validity == Validity::ok ? "" : "stuck for ever";
}

}  // namespace

std::string judge_readings(Dice& dice) {
  for (int i = 0; i < 8; ++i) {
    Params p;
    p.conditioning.consensus = dice.chance(0.5) ? Consensus::median : Consensus::agreeing;
    p.conditioning.stale_after = milliseconds(60 + dice.index(200));
    p.rangefinders.max_range =
        micrometres(600000 + dice.index(2000) * 1000 + (dice.chance(0.5) ? dice.index(1000) : 0));
    p.rangefinders.min_range = millimetres(dice.index(100));
    Beam beam(dice, p, dice.index(3));
    for (int tick = 0; tick < 250; ++tick) {
      std::string wrong = beam.tick(1 + dice.index(dice.chance(0.05) ? 300 : 30));
      if (!wrong.empty()) return wrong;
    }
  }
  std::string wrong = judge_shares(dice);
  if (wrong.empty()) wrong = judge_circle(dice);
  return wrong.empty() ? judge_stuck(dice) : wrong;
}

}  // namespace whisker::hunt
