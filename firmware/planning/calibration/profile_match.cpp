#include "firmware/planning/calibration/profile_match.hpp"

#include "firmware/math/fixed.hpp"
#include "firmware/math/trig.hpp"

namespace whisker::planning {
namespace {

constexpr int kRounds = 4;
constexpr uint32_t kSmooth = 60;  // mm
constexpr int kLeastEchoes = 24;
constexpr int32_t kLeastContrast = 4;  // mm of a sample
// Sixteenths. Twelve parts say too little of the spread, and less where one of them decides alone: its share
// is added. Two standard deviations then cover about 95 % (scripts/measure wheels).
constexpr uint32_t kWider = 16;

/// The vertex of the parabola through the points -kHalf..kHalf, in 1/256 of their distance from the middle.
/// False: there is no minimum.
bool vertex(const int64_t (&y)[ProfileMatch::kFinePoints], int32_t& at) noexcept {
  constexpr int64_t kN = ProfileMatch::kFinePoints;
  constexpr int64_t kH = ProfileMatch::kHalf;
  constexpr int64_t kS2 = kH * (kH + 1) * (2 * kH + 1) / 3;
  constexpr int64_t kS4 = kS2 * (3 * kH * kH + 3 * kH - 1) / 5;
  int64_t sum = 0, first = 0, second = 0;
  for (int i = 0; i < kN; ++i) {
    const int64_t k = i - kH;
    sum += y[i];
    first += k * y[i];
    second += k * k * y[i];
  }
  const int64_t bend = kN * second - kS2 * sum;  // times 1 / (kN kS4 - kS2^2)
  if (bend <= 0) return false;
  // slope = first / kS2, vertex = -slope / (2 bend')
  const int64_t numerator = quotient_64(-first * (kN * kS4 - kS2 * kS2), kS2);
  at = saturate32(divide_rounded_64(numerator, (2 * bend + 255) / 256));
  return true;
}

}  // namespace

int32_t ProfileMatch::per_sample(uint32_t cost) const noexcept {
  return samples_ == 0 ? 0 : static_cast<int32_t>(cost / static_cast<uint32_t>(samples_ * 16));
}

/// The earlier profile at this heading, between two samples: a cubic where it is smooth, else a line.
int32_t ProfileMatch::expected(int beam, int i, int32_t x) const noexcept {
  const RangeProfile::Sample& a = earlier_.at(beam, i);
  const RangeProfile::Sample& b = earlier_.at(beam, i + 1);
  const int32_t width = int32_t{b.at} - a.at;
  const int32_t into = x < a.at ? 0 : x > b.at ? width : x - a.at;
  const int32_t near = a.mm, far = b.mm;
  const int32_t line = near * 16 + (far - near) * 16 * into / width;
  if (i == 0 || i + 2 >= earlier_.count(beam)) return line;
  // Second differences: how much it bends.
  const int32_t at_a = far - 2 * near + earlier_.at(beam, i - 1).mm;
  const int32_t at_b = earlier_.at(beam, i + 2).mm - 2 * far + near;
  if (magnitude(at_a) > kSmooth || magnitude(at_b) > kSmooth) return line;
  const int32_t t = into * 256 / width;
  return line - t * (256 - t) / 256 * (at_a * (256 - t) + at_b * t) / 256 / 32;
}

uint32_t ProfileMatch::compare(int32_t offset, uint32_t* blocks) const noexcept {
  uint32_t all = 0;
  for (int beam = 0; beam < hal::kBeams; ++beam) {
    const int last = earlier_.count(beam) - 1;
    int i = 0;
    for (int j = 0; j < later_.count(beam); ++j) {
      const RangeProfile::Sample& seen = later_.at(beam, j);
      const int32_t x = seen.at - offset;
      while (i < last - 1 && earlier_.at(beam, i + 1).at <= x) ++i;
      const uint32_t difference = magnitude(int32_t{seen.mm} * 16 - expected(beam, i, x));
      const uint32_t cost = difference < kCap * 16 ? difference : kCap * 16;
      all += cost;
      if (blocks == nullptr) continue;
      constexpr int32_t kPerBeam = kBlocks / hal::kBeams;
      const int32_t part = (int32_t{seen.at} - kWindow) * kPerBeam / RangeProfile::kTurn;
      blocks[beam * kPerBeam + (part < 0 ? 0 : part < kPerBeam ? part : kPerBeam - 1)] += cost;
    }
  }
  return all;
}

void ProfileMatch::start() noexcept {
  trouble_ = Trouble::not_finished;
  point_ = rounds_ = 0;
  least_ = mean_ = 0;
  offset_ = sigma_ = 0;
  fine_now_ = false;
  samples_ = 0;
  over_ = false;
  for (int beam = 0; beam < hal::kBeams; ++beam) {
    samples_ += later_.count(beam);
    if (earlier_.count(beam) < 2 || later_.count(beam) < 2) over_ = true;
  }
  if (later_.echoes() < kLeastEchoes || earlier_.echoes() < kLeastEchoes) over_ = true;
  if (over_) trouble_ = Trouble::nothing_in_range;
}

bool ProfileMatch::step() noexcept {
  if (over_) return false;
  if (!fine_now_) {
    coarse_[point_] = compare(int32_t{point_} * kCoarse - kWindow, nullptr);
    if (++point_ == kCoarsePoints) judge();
  } else {
    uint32_t* const blocks = fine_[point_];
    for (int b = 0; b < kBlocks; ++b) blocks[b] = 0;
    compare(centre_ + (point_ - kHalf) * kFine, blocks);
    if (++point_ == kFinePoints && !refine()) measure();
  }
  return !over_;
}

/// Of the coarse search.
void ProfileMatch::judge() noexcept {
  uint64_t sum = 0;
  int best = 0;
  for (int i = 0; i < kCoarsePoints; ++i) {
    sum += coarse_[i];
    if (coarse_[i] < coarse_[best]) best = i;
  }
  least_ = coarse_[best];
  mean_ = static_cast<uint32_t>(quotient(sum, uint32_t{kCoarsePoints}));
  const uint32_t contrast = mean_ - least_;
  // The valley around the best offset, and the lowest point outside.
  int from = best, to = best;
  while (from > 0 && coarse_[from] < least_ + contrast / 2) --from;
  while (to < kCoarsePoints - 1 && coarse_[to] < least_ + contrast / 2) ++to;
  uint32_t second = UINT32_MAX;
  for (int i = 0; i < kCoarsePoints; ++i) {
    if ((i < from || i > to) && coarse_[i] < second) second = coarse_[i];
  }
  trouble_ = Trouble::none;
  if (contrast < static_cast<uint32_t>(samples_ * 16 * kLeastContrast))
    trouble_ = Trouble::no_features;
  else if (least_ > mean_ / 2)
    trouble_ = Trouble::scene_moved;
  else if (second < least_ + contrast / 4 || best == 0 || best == kCoarsePoints - 1)
    trouble_ = Trouble::ambiguous;
  over_ = trouble_ != Trouble::none;
  centre_ = best * kCoarse - kWindow;
  fine_now_ = true;
  point_ = 0;
}

/// True: searches around another centre.
bool ProfileMatch::refine() noexcept {
  int64_t y[kFinePoints];
  for (int i = 0; i < kFinePoints; ++i) {
    y[i] = 0;
    for (int b = 0; b < kBlocks; ++b) y[i] += fine_[i][b];
  }
  int32_t at = 0;
  over_ = !vertex(y, at);
  if (over_) {
    trouble_ = Trouble::too_uncertain;
    return true;
  }
  at = at > kHalf * 256 ? kHalf * 256 : at < -kHalf * 256 ? -kHalf * 256 : at;
  const int32_t steps = static_cast<int32_t>(divide_rounded(at, 256));
  offset_ = (centre_ * 256) + at * kFine;
  if (steps == 0 || ++rounds_ == kRounds) return false;
  centre_ += steps * kFine;
  point_ = 0;
  return true;
}

void ProfileMatch::measure() noexcept {
  over_ = true;
  int32_t without[kBlocks];
  int64_t sum = 0;
  for (int left_out = 0; left_out < kBlocks; ++left_out) {
    int64_t y[kFinePoints];
    for (int i = 0; i < kFinePoints; ++i) {
      y[i] = 0;
      for (int b = 0; b < kBlocks; ++b) y[i] += b == left_out ? 0 : fine_[i][b];
    }
    if (!vertex(y, without[left_out])) {
      trouble_ = Trouble::too_uncertain;
      return;
    }
    sum += without[left_out];
  }
  const int64_t mean = divide_rounded(sum, kBlocks);
  uint64_t squares = 0, largest = 0;
  for (const int32_t one : without) {
    const uint64_t d = static_cast<uint64_t>(square(one - mean));
    squares += d;
    largest = d > largest ? d : largest;
  }
  const uint32_t jackknife = square_root(quotient(squares * (kBlocks - 1), uint32_t{kBlocks}));
  const uint32_t dominance = squares == 0 ? 0 : static_cast<uint32_t>(quotient_64(largest * 16, squares));
  sigma_ = static_cast<int32_t>(jackknife * kFine * (kWider + dominance) / 16);
}

}  // namespace whisker::planning
