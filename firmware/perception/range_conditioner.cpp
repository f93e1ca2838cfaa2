#include "firmware/perception/range_conditioner.hpp"

namespace whisker::perception {
namespace {

constexpr uint32_t kSlowParts = 8;
constexpr Length kOdd = 100_mm;   // a single reading differs from those around it by more than this
constexpr Length kRoom = 500_mm;  // phantoms are nearer
constexpr Length kAlike = 40_mm;  // readings that confirm each other differ by at most this
constexpr Length kUndecided = Length::from_raw(-1);
constexpr int32_t kAveraged = 64;  // readings
constexpr int32_t kAveragedBeforeWall = 8 * kAveraged;
// Shares of single readings, 2^-16. The reference noise causes fewer than 0.05 % near ones.
constexpr uint16_t kFewPhantoms = 2621;
constexpr uint16_t kManyPhantoms = 6554;
constexpr uint16_t kFewMisses = 6554;

constexpr Length distance_of(Validity v, uint16_t mm, Length max_range) noexcept {
  if (v == Validity::ok) return millimetres(mm);
  return v == Validity::clear ? max_range : Length{};
}

constexpr Validity validity_of(Length d, Length max_range) noexcept {
  if (d == Length{}) return Validity::too_near;
  return d == max_range ? Validity::clear : Validity::ok;
}

}  // namespace

void BeamConditioner::reset(Time now) noexcept {
  *this = BeamConditioner{beam_};
  last_new_ = now;
  last_usable_ = now;
}

bool BeamConditioner::is_stuck(const hal::RangeReading& reading, const Pose& body,
                               const Params& params) noexcept {
  // A constant distance beyond the range may be how a sensor says that nothing is there.
  if (reading.status == hal::RangeStatus::ok && millimetres(reading.mm) < params.rangefinders.max_range) {
    return repetition_.stuck(reading.mm, body, derived::kStuckTurn);
  }
  repetition_.end();
  return false;
}

Validity BeamConditioner::classify(const hal::RangeReading& reading, const Pose& body, const Params& params,
                                   Health& health) noexcept {
  if (is_stuck(reading, body, params)) {
    count(health.range_stuck);
    return Validity::stuck;
  }
  switch (reading.status) {
    case hal::RangeStatus::ok:
      if (reading.mm > hal::kMostMm) break;
      if (millimetres(reading.mm) >= params.rangefinders.max_range) {
        // An echo at the maximum range may be rounded up to a whole millimetre.
        if (millimetres(reading.mm) - 1_mm >= params.rangefinders.max_range) {
          count(health.range_out_of_range);
        }
        return Validity::clear;
      }
      if (millimetres(reading.mm) < params.rangefinders.min_range) {
        count(health.range_out_of_range);
        return Validity::too_near;
      }
      return reading.mm == 0 ? Validity::too_near : Validity::ok;
    case hal::RangeStatus::clear: return Validity::clear;
    case hal::RangeStatus::too_near: return Validity::too_near;
    case hal::RangeStatus::invalid:
    case hal::RangeStatus::stale: break;
  }
  // A status or a distance that there is not also ends here: the reading is damaged.
  count(health.range_invalid);
  return Validity::invalid;
}

void BeamConditioner::age(Time now, const Params& params, Health& health) noexcept {
  if (now - last_new_ <= params.conditioning.stale_after) return;
  if (latest_.validity != Validity::stale) count(health.range_stale);
  latest_ = {Length{}, Validity::stale};
}

void BeamConditioner::miss(Time now, const Params& params, Health& health) noexcept {
  fresh_ = false;
  age(now, params, health);
}

void BeamConditioner::update(const hal::RangeReading& reading, Time now, const Pose& body,
                             const Params& params, Health& health) noexcept {
  fresh_ = false;
  const bool seen = reading.sequence == sequence_;
  // The pose at the time of such an old reading is unknown.
  const bool nothing = reading.status == hal::RangeStatus::stale || reading.age_ms == UINT8_MAX;
  if (seen || nothing) {
    age(now, params, health);
    return;
  }
  sequence_ = reading.sequence;
  last_new_ = now;
  const Validity validity = classify(reading, body, params, health);
  latest_ = {distance_of(validity, reading.mm, params.rangefinders.max_range), validity};
  if (!usable(validity)) return;

  fresh_ = true;
  last_usable_ = now;
  newest_ = static_cast<int8_t>((newest_ + 1) % kHistory);
  history_[newest_] = {latest_.distance, now - milliseconds(reading.age_ms)};
  if (count_ < kHistory) ++count_;
  judge(body.heading - heading_, params);
  heading_ = body.heading;
}

Length BeamConditioner::distance(int back) const noexcept { return recent(back).distance; }

void BeamConditioner::judge(Angle turned, const Params& params) noexcept {
  // In a faster turn, the cone may meet a thin object in a single reading.
  const bool slow = magnitude(turned) <= beam_cone(params.rangefinders, beam_).raw() / kSlowParts;
  steady_ = !slow ? int8_t{0} : steady_ < kHistory ? static_cast<int8_t>(steady_ + 1) : steady_;
  if (count_ < kHistory || steady_ < kHistory) return;
  const Length last[kHistory] = {distance(0), distance(1), distance(2), distance(3), distance(4)};
  const Length middle = last[kHistory / 2];
  const Length most = params.rangefinders.max_range;
  Length nearest = most;
  Length farthest;
  for (int i = 0; i < kHistory; ++i) {
    if (i == kHistory / 2) continue;
    nearest = min(nearest, last[i]);
    farthest = max(farthest, last[i]);
  }
  // Phantoms that surround a true reading differ.
  const bool echo = farthest < most - kOdd && farthest - nearest <= kAlike;
  const auto follow = [](uint16_t& share, bool seen, int32_t averaged) {
    const int32_t step = ((seen ? int32_t{UINT16_MAX} : 0) - share) / averaged;
    share = narrow<uint16_t>(share + step);
  };
  // Only where there is room for a phantom, or something to miss. Before a wall, phantoms may be rare.
  const bool near = nearest > middle + kOdd;
  if (nearest > kRoom) follow(phantoms_, near, near || nearest == most ? kAveraged : kAveragedBeforeWall);
  if (echo) follow(misses_, farthest < middle - kOdd, kAveraged);
  const Length before = last[kHistory / 2 + 1];
  const Length after = last[kHistory / 2 - 1];
  const auto like = [](Length a, Length b) { return abs(a - b) <= kOdd; };
  // Two phantoms in a row may be alike, three hardly.
  const bool object = before < most - kOdd && like(before, after) &&
                      (like(before, last[kHistory - 1]) || like(after, last[0]));
  if (object) follow(false_clear_share_, middle == most, kAveraged * 2);
}

Length BeamConditioner::confirmed(const Length (&last)[kHistory], Length far) const noexcept {
  Length sorted[kHistory];
  for (int i = 0; i < kHistory; ++i) {
    int slot = i;
    for (; slot > 0 && sorted[slot - 1] > last[i]; --slot) sorted[slot] = sorted[slot - 1];
    sorted[slot] = last[i];
  }
  const bool misses = misses_ > kFewMisses;
  const int wanted = misses ? 2 : phantoms_ > kManyPhantoms ? 4 : 3;
  // Where misses are frequent, four readings that agree on nothing do not outweigh a lone echo.
  bool pair = misses;
  for (int i = 0; i + 1 < kHistory; ++i) {
    if (sorted[i + 1] - sorted[i] > kAlike) continue;
    if (sorted[i] == far) return pair && i > 0 ? kUndecided : far;
    if (i + wanted <= kHistory && sorted[i + wanted - 1] - sorted[i] <= kAlike) return sorted[i];
    pair = true;
  }
  return kUndecided;
}

RecentReadings BeamConditioner::sight(const Params& params) const noexcept {
  constexpr int kNear = 4;
  constexpr int kTypical = 3;
  RecentReadings s;
  if (count_ < kNear) return s;
  s.misses = misses_ > kFewMisses;
  s.phantoms = phantoms_ > kFewPhantoms;
  // The fifth may not be there, and is then not asked for.
  const Length last[kHistory] = {distance(0), distance(1), distance(2), distance(3), distance(4)};
  const Length low = min(last[0], last[1]);
  const Length high = max(last[0], last[1]);
  const Length far = params.rangefinders.max_range;
  Length median = max(low, min(high, last[kTypical - 1]));
  const bool confirmable = s.phantoms && steady_ == kHistory && count_ == kHistory;
  Length nearest;
  bool agreed = true;
  if (confirmable) {
    nearest = confirmed(last, far);
    agreed = nearest != kUndecided;
    median = agreed ? nearest : far;
  }
  s.typical = {median, validity_of(median, far)};
  if (!fresh_ || !agreed) return s;
  if (!confirmable) {
    nearest = min(min(low, last[2]), last[3]);
    if (s.misses) nearest = min(nearest, last[kNear]);
  }
  // Two that nothing confirms may be an object that has just come into view.
  s.fresh = last[0] >= nearest || last[1] >= nearest;
  s.taken = history_[newest_].taken;
  s.oldest = recent(kNear - 1).taken;
  s.near = {nearest, validity_of(nearest, far)};
  s.single = last[0] == far || last[0] < nearest;
  s.first_clear = false_clear_share_ != 0 && last[0] == far && last[1] < far;
  s.newest = {last[0], validity_of(last[0], far)};
  s.farthest = max(high, last[kTypical - 1]);
  s.measured =
      min(low, last[2]) > Length{} && s.farthest < far && (!s.phantoms || s.farthest - nearest <= kAlike);
  s.bend = abs(last[0] - last[1] * 2 + last[2]);
  return s;
}

Echo BeamConditioner::look(Time since, const Params& params) const noexcept {
  constexpr int kWanted = derived::kConsensusReads;
  if (count_ < kWanted) return {};
  Length sorted[kWanted];
  for (int i = 0; i < kWanted; ++i) {
    const Measurement& m = recent(i);
    if (m.taken - since < Duration{}) return {};
    int slot = i;
    for (; slot > 0 && sorted[slot - 1] > m.distance; --slot) sorted[slot] = sorted[slot - 1];
    sorted[slot] = m.distance;
  }
  Length agreed = sorted[(kWanted - 1) / 2];
  switch (params.conditioning.consensus) {
    case Consensus::agreeing:
      if (sorted[kWanted - 1] - sorted[0] > derived::kConsensusTolerance) return {};
      agreed = sorted[0];
      break;
    case Consensus::median: break;
  }
  return {agreed, validity_of(agreed, params.rangefinders.max_range)};
}

void RangeConditioner::reset(Time now) noexcept {
  for (BeamConditioner& b : beam_) b.reset(now);
}

void RangeConditioner::update(const hal::RangeReadings* readings, Time now, const Pose& body,
                              const Params& params, Health& health) noexcept {
  for (int i = 0; i < hal::kBeams; ++i) {
    if (readings != nullptr) {
      beam_[i].update(readings->beam[i], now, body, params, health);
    } else {
      beam_[i].miss(now, params, health);
    }
  }
}

void RangeConditioner::put_down() noexcept {
  for (BeamConditioner& b : beam_) b.put_down();
}

Echoes RangeConditioner::look(Time since, const Params& params) const noexcept {
  Echoes e;
  for (int i = 0; i < hal::kBeams; ++i) e.beam[i] = beam_[i].look(since, params);
  return e;
}

Echoes RangeConditioner::latest() const noexcept {
  Echoes e;
  for (int i = 0; i < hal::kBeams; ++i) e.beam[i] = beam_[i].latest();
  return e;
}

uint16_t RangeConditioner::phantom_share() const noexcept {
  uint16_t most = 0;
  for (const BeamConditioner& b : beam_) most = b.phantom_share() > most ? b.phantom_share() : most;
  return most;
}

uint16_t RangeConditioner::false_clear_share() const noexcept {
  uint16_t most = 0;
  for (const BeamConditioner& b : beam_) most = b.false_clear_share() > most ? b.false_clear_share() : most;
  return most;
}

Duration RangeConditioner::lost_for(Time now) const noexcept {
  Duration longest;
  for (const BeamConditioner& b : beam_) longest = max(longest, b.lost_for(now));
  return longest;
}

}  // namespace whisker::perception
