#include "firmware/perception/perception.hpp"

namespace whisker::perception {
namespace {

constexpr Length kSamePlace = 20_mm;
constexpr uint8_t kMostTakenBack = 16;  // times at one place
constexpr Length kAppears = 50_mm;      // nearer than the reading before: another object
constexpr int32_t kFlankRadii = 2;
// The side of a disc at which a beam looks at an angle does not show before its nearer part does.
constexpr int32_t kFlankRadiiOfLostWalls = 4;

}  // namespace

void Perception::configure(const Params& params) noexcept {
  loses_walls_ = loses_walls(params.rangefinders);
  for (int i = 0; i < hal::kBeams; ++i) mounts_[i] = mount(params.rangefinders, i);
  local_grid_.configure(params);
  contacts_.configure(params.body.radius);
  motion_.configure(mounts_);
  monitor_.configure(params);
  const Duration reach = params.rangefinders.latency + milliseconds(1000 / params.rangefinders.rate_hz);
  history_.configure(reach / (localization::PoseHistory::kKept - 2));
}

void Perception::forget(const Pose& pose) noexcept {
  conditioner_.put_down();
  history_.reset();
  local_grid_.reset(pose);
  contacts_.reset();
  motion_.reset();
  monitor_.reset();
  vouched_.any = false;
  seen_ = 0;
  contradicted_ = 0;
  misses_ = false;
  for (Contradiction& contradiction : contradictions_) contradiction = {};
  for (RangeScatter& scatter : scatter_) scatter = {};
}

bool Perception::vouch(Length radius, const Pose& body) noexcept {
  const Echoes echoes = latest();
  if (!usable(echoes)) return false;
  Beam beams[hal::kBeams];
  Length free[hal::kBeams];
  for (int i = 0; i < hal::kBeams; ++i) {
    beams[i] = beam_of(mounts_[i], body);
    free[i] = echoes.beam[i].distance;
  }
  vouched_.any = true;
  vouched_.at = body.at;
  local_grid_.vouch(body.at, radius, beams, free);
  return true;
}

/// Drops it once all vouched cells have left the window.
void Perception::leave_vouched(Vec body) noexcept {
  if (vouched_.any && farther(body - vouched_.at, local_grid_.half_window() * 5 / 2)) vouched_.any = false;
}

/// A cone that is narrower than stated clears ground at its edges that it does not see, and any unclear cell
/// would explain the echo. Where walls vanish or readings miss objects, echoes appear too often for that. So
/// they do while the body turns at one place, and a look must come to an end.
bool Perception::takes_back(Vec body) noexcept {
  if (loses_walls_ || misses_) return false;
  if (farther(body - taken_back_at_, kSamePlace)) {
    taken_back_at_ = body;
    taken_back_ = 0;
  }
  if (taken_back_ == kMostTakenBack) return false;
  ++taken_back_;
  return true;
}

void Perception::sense(const hal::RangeReadings* readings, Time now, const Pose& body, const Params& params,
                       Health& health) noexcept {
  if (readings == nullptr) count(health.range_refused);
  conditioner_.update(readings, now, body, params, health);
}

void Perception::observe(const Standing& body, const Params& params, Percept& out) noexcept {
  if (body.settled) out.static_scan = conditioner_.look(body.settled_since, params);
  history_.add(body.pose, body.now);
  local_grid_.move_to(body.pose);
  monitor_.move_to(body.pose.at);
  leave_vouched(body.pose.at);
  Length free[hal::kBeams];
  Length moved[hal::kBeams];
  bool appears[hal::kBeams] = {};
  Length echo_ends[hal::kBeams];
  bool too_near[hal::kBeams] = {};
  SeenRange shown[hal::kBeams];
  // Beams that point beside their axes cause contradictions wherever the robot passes. More of them refute
  // that.
  const bool misaimed = !loses_walls_ && contradicted_ >= kMisaimed && contradicted_ < kMisaimed * 2;
  Pose from;
  uint8_t hits = 0;
  int seen = 0;
  readings_err_ = misses_;
  for (int i = 0; i < hal::kBeams; ++i) {
    const RecentReadings sight = conditioner_.sight(i, params);
    readings_err_ = readings_err_ || sight.phantoms || sight.misses;
    out.moving_scan.beam[i] = sight.typical;
    if (!sight.fresh) continue;
    out.sighted = true;
    ConeObservation& observation = out.observations[i];
    if (!history_.at(sight.taken, from)) continue;
    observation.number = static_cast<int8_t>(i);
    observation.beam = beam_of(mounts_[i], from);
    const Length proving = proving_range(params.rangefinders, i);
    scatter_[i].add(sight);
    if (sight.newest.validity == Validity::ok) {
      shown[i] = {static_cast<uint16_t>(sight.newest.distance.raw() / 1000), scatter_[i].allowance()};
    }
    misses_ = misses_ || sight.misses;
    // What contradicted was a phantom.
    if (sight.phantoms) contradicted_ = 0;
    observation.hit = sight.near.validity != Validity::clear && sight.near.distance <= proving;
    const Length allowance = observation.hit ? scatter_[i].allowance() : Length{};
    observation.free = free[i] = max(Length{}, min(sight.near.distance, proving) - allowance);
    // Of readings that scatter, the nearest of four lies before the object, and so does its allowance; the
    // newest may lie before it by as much. A wall just behind then explains the echo of its own face, and the
    // flank's ground stays clear. Where walls vanish at an angle, the echo may come from an object that
    // showed no side.
    echo_ends[i] = observation.free;
    if (allowance > Length{}) {
      echo_ends[i] = max(observation.free, sight.newest.distance);
      if (loses_only_grazed(params.rangefinders)) echo_ends[i] += allowance;
    }
    observation.aimed = body.settled && sight.oldest - body.settled_since >= Duration{};
    observation.taken = sight.taken;
    if (observation.hit &&
        motion_.contradicts(observation.beam, observation.free, sight.farthest, misaimed, local_grid_)) {
      const bool approaches = contradictions_[i].approaches(observation);
      if (!sight.phantoms) monitor_.contradict(approaches);
      const bool anew = !local_grid_.doubting() && !approaches && !sight.phantoms;
      if (anew && contradicted_ < kDistrusted) ++contradicted_;
      const bool explained = loses_walls_ || misses_ || sight.phantoms || contradicted_ >= kDistrusted;
      if (approaches || !explained) moved[i] = sight.farthest;
    }
    // It may be anywhere up to the minimum range.
    too_near[i] = sight.newest.validity == Validity::too_near;
    if (too_near[i]) echo_ends[i] = max(echo_ends[i], min_range(params.rangefinders, i));
    const uint8_t bit = static_cast<uint8_t>(1U << i);
    if (observation.hit) hits = static_cast<uint8_t>(hits | bit);
    // A single clear reading is not evidence: it needs a second one.
    const EarlierObservation* const before = sight.single ? &last_[i] : nullptr;
    if (!sight.single || (seen_ & bit) != 0) {
      local_grid_.mark(observation, before);
      local_grid_.chain(observation, before);
    }
    appears[i] = (seen_ & bit) != 0 && last_[i].free > observation.free + kAppears;
    last_[i] = {observation.beam.apex, observation.beam.axis, observation.free};
    seen_ |= bit;
    out.observed = static_cast<uint8_t>(out.observed | bit);
    ++seen;
  }
  Length nearest;
  // After all marks, because another beam may clear ground that an echo takes back, or into which a moving
  // object is about to drive.
  for (int i = 0; i < hal::kBeams; ++i) {
    const bool echo = (out.observed >> i & 1U) != 0 && out.observations[i].hit;
    if (echo) {
      local_grid_.revoke(out.observations[i].beam, out.observations[i].free, echo_ends[i]);
      // What stands on clear ground would be explained by any unclear cell of so deep an arc.
      const bool hides = too_near[i] && (loses_walls_ || misses_);
      if (hides || (appears[i] && takes_back(body.pose.at)) || vouched_.any) {
        local_grid_.take_back(out.observations[i].beam, out.observations[i].free, echo_ends[i]);
      }
      if (appears[i]) {
        local_grid_.revoke_beside(out.observations[i], echo_ends[i],
                                  loses_walls_ ? kFlankRadiiOfLostWalls : kFlankRadii);
      }
    }
    if (moved[i] == Length{}) continue;
    local_grid_.doubt(out.observations[i], moved[i]);
    if (out.mover.seen && free[i] >= nearest) continue;
    nearest = free[i];
    const Beam& beam = out.observations[i].beam;
    out.mover.at = beam.apex + polar(beam.axis, nearest);
    out.mover.seen = true;
    if (!motion_.came_from(out.mover.at, out.mover.direction)) {
      out.mover.direction = bearing(body.pose.at - out.mover.at);
    }
  }
  for (int i = 0; i < contacts_.count(); ++i) local_grid_.block(contacts_.at(i), contacts_.radius());
  out.contacts = &contacts_;
  if (seen > 0) monitor_.see(from, shown, mounts_);
  if (seen == hal::kBeams) motion_.add(from, out.observations[0].taken, free, hits);
  monitor_.judge(conditioner_.phantom_share(), conditioner_.false_clear_share());
  out.doubts = doubts();
  out.local_grid = &local_grid_;
}

}  // namespace whisker::perception
