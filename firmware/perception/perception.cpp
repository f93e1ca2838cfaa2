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
  for (int i = 0; i < hal::kBeams; ++i) approaches_[i].configure(params, mounts_[hal::kFront], mounts_[i]);
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
  waits_ = false;
  put_off_ = 0;
  seen_ = 0;
  contradicted_ = 0;
  misses_ = false;
  for (Contradiction& contradiction : contradictions_) contradiction = {};
  for (ApproachWatch& approach : approaches_) approach.reset();
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
  local_grid_.begin_tick();
  if (readings == nullptr) count(health.range_refused);
  conditioner_.update(readings, now, body, params, health);
}

/// The readings of a tick on their way into the grid.
struct Perception::Intake {
  const Standing& body;
  const Params& params;
  Percept& out;
  const bool misaimed = false;
  Pose from;  // where the body was at the last of the readings
  Shown shown[hal::kBeams];
};

void Perception::observe(const Standing& body, const Params& params, Percept& out) noexcept {
  if (body.settled) out.static_scan = conditioner_.look(body.settled_since, params);
  history_.add(body.pose, body.now);
  local_grid_.move_to(body.pose);
  monitor_.move_to(body.pose.at);
  leave_vouched(body.pose.at);
  // Beams that point beside their axes cause contradictions wherever the robot passes. More of them refute
  // that.
  const bool misaimed = !loses_walls_ && contradicted_ >= kMisaimed && contradicted_ < kMisaimed * 2;
  Intake in{body, params, out, misaimed, {}, {}};
  readings_err_ = misses_;
  for (int i = 0; i < hal::kBeams; ++i) take_in(i, in);
  // After all marks, because another beam may clear ground that an echo takes back, or into which a moving
  // object is about to drive.
  for (int i = 0; i < hal::kBeams; ++i) {
    const ConeObservation& observation = out.observations[i];
    if (observation.hit) revoke(observation, in.shown[i], body.pose.at);
    if (in.shown[i].moved != Length{}) doubt(observation, in.shown[i].moved, body.pose.at, out.mover);
  }
  for (int i = 0; i < contacts_.count(); ++i) local_grid_.block(contacts_.at(i), contacts_.radius());
  learn(in);
  out.contacts = &contacts_;
  out.doubts = doubts();
  out.local_grid = &local_grid_;
}

void Perception::put_off(Percept& out) noexcept {
  const bool now = waits_;
  waits_ = out.sighted && !now;
  out.sighted = now;
  for (int i = 0; i < hal::kBeams; ++i) {
    const uint8_t bit = static_cast<uint8_t>(1U << i);
    ConeObservation& observation = out.observations[i];
    if ((out.observed & bit) != 0) {
      put_off_ |= bit;
      put_off_hits_ = static_cast<uint8_t>((put_off_hits_ & ~bit) | (observation.hit ? bit : 0U));
    } else if (now && (put_off_ & bit) != 0) {
      observation.number = static_cast<int8_t>(i);
      observation.beam = {last_[i].apex, last_[i].axis, mounts_[i].half_cone};
      observation.free = last_[i].free;
      observation.hit = (put_off_hits_ & bit) != 0;
    }
  }
  out.observed = now ? put_off_ : 0;
  if (now) put_off_ = 0;
}

/// What the beam has measured since the last tick, if anything.
void Perception::take_in(int i, Intake& in) noexcept {
  const RecentReadings sight = conditioner_.sight(i, in.params);
  readings_err_ = readings_err_ || sight.phantoms || sight.misses;
  in.out.moving_scan.beam[i] = sight.typical;
  if (!sight.fresh) return;
  in.out.sighted = true;
  if (!history_.at(sight.taken, in.from)) return;
  scatter_[i].add(sight);
  misses_ = misses_ || sight.misses;
  // What contradicted was a phantom.
  if (sight.phantoms) contradicted_ = 0;
  measure(i, sight, in);
  const ConeObservation& observation = in.out.observations[i];
  if (observation.hit) {
    in.shown[i].moved = moved(observation, sight, in.misaimed);
  } else {
    approaches_[i].reset();
  }
  in.shown[i].appears = mark(observation, sight);
  in.out.observed = static_cast<uint8_t>(in.out.observed | 1U << i);
}

void Perception::measure(int i, const RecentReadings& sight, Intake& in) noexcept {
  const RangefinderParams& sensors = in.params.rangefinders;
  ConeObservation& observation = in.out.observations[i];
  Shown& shown = in.shown[i];
  const Length proving = proving_range(sensors);
  const Length scatter = scatter_[i].allowance();
  observation.number = static_cast<int8_t>(i);
  observation.beam = beam_of(mounts_[i], in.from);
  observation.taken = sight.taken;
  observation.aimed = in.body.settled && sight.oldest - in.body.settled_since >= Duration{};
  observation.hit = sight.near.validity != Validity::clear && sight.near.distance <= proving;
  const Length allowance = observation.hit ? scatter : Length{};
  observation.free = max(Length{}, min(sight.near.distance, proving) - allowance);
  // Of readings that scatter, the nearest of four lies before the object, and so does its allowance; the
  // newest may lie before it by as much. A wall just behind then explains the echo of its own face, and the
  // flank's ground stays clear. Where walls vanish at an angle, the echo may come from an object that
  // showed no side.
  shown.echo_ends = observation.free;
  if (allowance > Length{}) {
    shown.echo_ends = max(observation.free, sight.newest.distance);
    if (loses_only_grazed(sensors)) shown.echo_ends += allowance;
  }
  // It may be anywhere up to the minimum range.
  shown.too_near = sight.newest.validity == Validity::too_near;
  if (shown.too_near) shown.echo_ends = max(shown.echo_ends, sensors.min_range);
  if (sight.newest.validity == Validity::ok) {
    shown.range = {narrow<uint16_t>(sight.newest.distance.raw() / 1000), scatter};
  }
}

/// An echo from clear ground. Returns up to where what moves may be; zero: nothing does, or the sensors
/// explain the echo.
Length Perception::moved(const ConeObservation& observation, const RecentReadings& sight,
                         bool misaimed) noexcept {
  if (!motion_.contradicts(observation.beam, observation.free, sight.farthest, misaimed, local_grid_)) {
    return {};
  }
  const bool approaches = contradictions_[observation.number].approaches(observation);
  if (!sight.phantoms) monitor_.contradict(approaches);
  const bool anew = !local_grid_.doubting() && !approaches && !sight.phantoms;
  if (anew && contradicted_ < kDistrusted) ++contradicted_;
  const bool explained = loses_walls_ || misses_ || sight.phantoms || contradicted_ >= kDistrusted;
  return approaches || !explained ? sight.farthest : Length{};
}

/// True: something has come into the beam since its last reading.
bool Perception::mark(const ConeObservation& observation, const RecentReadings& sight) noexcept {
  EarlierObservation& last = last_[observation.number];
  const uint8_t bit = static_cast<uint8_t>(1U << observation.number);
  const bool had_one = (seen_ & bit) != 0;
  // A single clear reading is not evidence: it needs a second one.
  if (!sight.single || had_one) {
    const EarlierObservation* const before = sight.single ? &last : nullptr;
    const LocalGrid::Apexes at = local_grid_.apexes(observation, before);
    local_grid_.mark(observation, before, at);
    local_grid_.chain(observation, before, at);
  }
  const bool appears = had_one && last.free > observation.free + kAppears;
  // Two clear ones in a row may both be false: the second one then needs the one before the first.
  if (!sight.first_clear || !had_one) last = {observation.beam.apex, observation.beam.axis, observation.free};
  seen_ |= bit;
  return appears;
}

/// Clear ground from which the echo may come.
void Perception::revoke(const ConeObservation& echo, const Shown& shown, Vec body) noexcept {
  local_grid_.revoke(echo.beam, echo.free, shown.echo_ends);
  // What stands on clear ground would be explained by any unclear cell of so deep an arc.
  const bool hides = shown.too_near && (loses_walls_ || misses_);
  const bool ends = approaches_[echo.number].ends_at_body(echo);
  if (hides || ends || (shown.appears && takes_back(body)) || vouched_.any) {
    local_grid_.take_back(echo.beam, echo.free, shown.echo_ends);
  }
  if (!shown.appears) return;
  local_grid_.revoke_beside(echo, shown.echo_ends, loses_walls_ ? kFlankRadiiOfLostWalls : kFlankRadii);
}

/// Something moves in the beam, up to this distance. The nearest of all beams is the mover.
void Perception::doubt(const ConeObservation& echo, Length farthest, Vec body, Mover& mover) noexcept {
  local_grid_.doubt(echo, farthest);
  if (mover.seen && echo.free >= mover.distance) return;
  mover.seen = true;
  mover.distance = echo.free;
  mover.at = echo.beam.apex + polar(echo.beam.axis, echo.free);
  if (!motion_.came_from(mover.at, mover.direction)) mover.direction = bearing(body - mover.at);
}

/// What the readings tell of the sensors, and of scenes to come.
void Perception::learn(const Intake& in) noexcept {
  SeenRange ranges[hal::kBeams];
  Length free[hal::kBeams];
  uint8_t hits = 0;
  for (int i = 0; i < hal::kBeams; ++i) {
    const ConeObservation& observation = in.out.observations[i];
    ranges[i] = in.shown[i].range;
    free[i] = observation.free;
    if (observation.hit) hits = static_cast<uint8_t>(hits | 1U << i);
  }
  constexpr uint8_t kAll = (1U << hal::kBeams) - 1;
  if (in.out.observed != 0) monitor_.see(in.from, ranges, mounts_);
  if (in.out.observed == kAll) motion_.add(in.from, in.out.observations[0].taken, free, hits);
  monitor_.judge(conditioner_.phantom_share(), conditioner_.false_clear_share());
}

}  // namespace whisker::perception
