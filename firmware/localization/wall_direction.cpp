#include "firmware/localization/wall_direction.hpp"

#include "firmware/localization/wall_fit.hpp"

namespace whisker::localization {
namespace {

constexpr Length kMean = 60_mm;                         // of the wall, for one mean
constexpr int kLeast = 5;                               // means
constexpr Length kStep = 60_mm;                         // between two points, at most
constexpr Length kBend = 8_mm;                          // of a mean from the line, at most
constexpr Length kRough = Length::from_raw(4000);       // residual of the means, at most
constexpr Length kLeastError = Length::from_raw(2500);  // of a mean
constexpr Angle kTurn = 10_deg;                         // of the body meanwhile, at most
constexpr Angle kAlongside = 30_deg;                    // between line and heading, at most
constexpr Angle kMostAhead = 15_deg;                    // what is farther off is hardly one of the walls
constexpr Angle kFloor = Angle::turns(1, 3600);         // walls are not quite straight
constexpr uint8_t kMostPoints = 200;
constexpr int kPlaceShift = 6;  // um to the unit of a place; a run is shorter than the 2 m that it allows
constexpr int64_t kRadian = 683565276;  // 2^-32 turn

/// Modulo 2^-bits turn, the nearest to zero.
int32_t apart(Angle a, int bits) noexcept { return as_signed(a.raw() << bits) >> bits; }

int16_t sixteen_bits(Angle a) noexcept { return static_cast<int16_t>(a.wrapped() >> 16); }
Angle turned(int16_t heading) noexcept {
  return Angle::from_raw(static_cast<uint32_t>(static_cast<uint16_t>(heading)) << 16);
}

}  // namespace

void WallDirection::restart() noexcept {
  for (Run& run : runs_) drop(run);
  earlier_sigma_ = {};
}

bool WallDirection::pass(hal::Beam side, const Echo* echo, Angle direction, Found& found) noexcept {
  Run& run = runs_[side == hal::kLeft ? 0 : 1];
  const bool any = run.points > 0;
  const bool ends = echo == nullptr || farther(echo->at - point(run, run.last), kStep) ||
                    magnitude(echo->heading - turned(run.heading)) > kTurn.raw();
  bool done = false;
  if (any && ends) {
    done = finish(run, direction, found);
    drop(run);
  }
  if (echo == nullptr) return done;
  add(run, *echo);
  if (run.count < kMeans) return done;
  done = finish(run, direction, found);
  // The wall goes on: the last mean has not counted yet.
  const Vec last = point(run, run.means[kMeans - 1]);
  run.origin = point(run, run.means[kMeans - 2]);
  run.means[0] = {0, 0};
  run.means[1] = place(run, last);
  run.count = 2;
  run.last = place(run, echo->at);
  run.heading = sixteen_bits(echo->heading);
  return done;
}

void WallDirection::add(Run& run, const Echo& echo) noexcept {
  if (run.points == 0) {
    if (run.count == 0) {
      run.heading = sixteen_bits(echo.heading);
      run.origin = echo.at;
    }
    run.from = echo.at;
    run.x = run.y = 0;
  }
  run.last = place(run, echo.at);
  const Vec way = echo.at - run.from;
  if (run.points < kMostPoints) {
    run.x += way.x.raw();
    run.y += way.y.raw();
    ++run.points;
  }
  if (!farther(way, kMean)) return;
  const Vec mean{Length::from_raw(run.x / run.points), Length::from_raw(run.y / run.points)};
  run.means[run.count++] = place(run, run.from + mean);
  run.from = echo.at;
  run.x = run.y = 0;
  run.points = 1;
}

WallDirection::Place WallDirection::place(const Run& run, Vec at) noexcept {
  const Vec from = at - run.origin;
  return {narrow<int16_t>(scale_down<kPlaceShift>(from.x.raw())),
          narrow<int16_t>(scale_down<kPlaceShift>(from.y.raw()))};
}

Vec WallDirection::point(const Run& run, const Place& place) noexcept {
  return run.origin +
         Vec{Length::from_raw(place.x * (1 << kPlaceShift)), Length::from_raw(place.y * (1 << kPlaceShift))};
}

bool WallDirection::finish(const Run& run, Angle direction, Found& found) noexcept {
  const int count = run.count - 2;
  if (count < kLeast) return false;
  Vec means[kMeans - 2];
  for (int i = 0; i < count; ++i) means[i] = point(run, run.means[i + 1]);
  const WallLine line = wall_line(means, count);
  // Of means one behind the other, the spread is larger.
  if (line.residual > kRough || line.spread < kMean) return false;
  for (int i = 0; i < count; ++i) {
    if (abs(across(means[i] - line.middle, line.direction)) > kBend) return false;
  }
  const uint32_t aside = magnitude(apart(line.direction - turned(run.heading), 1));
  if (aside > kAlongside.raw()) return false;
  const int32_t ahead = apart(direction - line.direction, 2);
  if (magnitude(ahead) > kMostAhead.raw()) return false;
  // Of count means, the line leaves count - 2 free.
  const Length error = max(kLeastError, line.residual * count / (count - 2));
  const int64_t over =
      int64_t{line.spread.raw()} * as_signed(square_root(static_cast<uint64_t>(count) << 16));
  found.ahead = Angle::from_raw(static_cast<uint32_t>(ahead));
  found.sigma = Angle::from_raw(narrow<uint32_t>(quotient_64(error.raw() * (kRadian << 8), over))) + kFloor;
  const bool agrees = earlier_sigma_ != Angle{} && magnitude(apart(line.direction - earlier_, 2)) <=
                                                       2 * (earlier_sigma_ + found.sigma).raw();
  earlier_ = line.direction;
  earlier_sigma_ = found.sigma;
  return agrees;
}

}  // namespace whisker::localization
