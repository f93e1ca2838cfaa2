/// The heading by which a later turn's profile is ahead of an earlier one's.
#pragma once

#include <stdint.h>

#include "firmware/planning/calibration/range_profile.hpp"
#include "firmware/planning/calibration/trouble.hpp"

namespace whisker::planning {

/// Searches the offset at which the later profile differs least from the earlier one: the sum over its
/// samples of the difference in distance, each at most kCap. First in steps of kCoarse over +-kWindow, then
/// finely, where a parabola gives the minimum. The standard deviation is that of a jackknife over kBlocks
/// parts of the later profile.
class ProfileMatch {
 public:
  /// The earlier profile covers a turn and kWindow more on both sides: from 0 to kTurn + 2 kWindow. The later
  /// one covers kWindow to kTurn + kWindow.
  static constexpr int32_t kWindow = 6144;  // 46 degrees
  static constexpr int32_t kCoarse = 64;
  static constexpr int kCoarsePoints = 2 * kWindow / kCoarse + 1;
  static constexpr int32_t kFine = 36;
  static constexpr int kHalf = 12;
  static constexpr int kFinePoints = 2 * kHalf + 1;
  static constexpr int kBlocks = 12;
  static constexpr int32_t kCap = 150;  // mm

  /// Both must outlive the search.
  ProfileMatch(const RangeProfile& earlier, const RangeProfile& later) noexcept
      : earlier_(earlier), later_(later) {}

  void start() noexcept;
  /// A part of the work, as much as one comparison of all samples. False: it is over.
  bool step() noexcept;

  Trouble trouble() const noexcept { return trouble_; }
  /// The later profile less the earlier one, 1/256 of a profile's unit; valid without trouble.
  int32_t offset() const noexcept { return offset_; }
  int32_t sigma() const noexcept { return sigma_; }
  /// Mean difference of a sample, mm: at the minimum, and over all offsets.
  int32_t least() const noexcept { return per_sample(least_); }
  int32_t mean() const noexcept { return per_sample(mean_); }
  /// The same at an offset of point * kCoarse - kWindow.
  int32_t mismatch(int point) const noexcept { return per_sample(coarse_[point]); }

 private:
  int32_t per_sample(uint32_t cost) const noexcept;
  int32_t expected(int beam, int i, int32_t x) const noexcept;  // 1/16 mm
  uint32_t compare(int32_t offset, uint32_t* blocks) const noexcept;
  void judge() noexcept;
  bool refine() noexcept;
  void measure() noexcept;

  const RangeProfile& earlier_;
  const RangeProfile& later_;
  uint32_t coarse_[kCoarsePoints] = {};
  uint32_t fine_[kFinePoints][kBlocks] = {};
  int32_t centre_ = 0;
  int point_ = 0;
  int rounds_ = 0;
  int samples_ = 0;
  bool fine_now_ = false;
  bool over_ = true;
  uint32_t least_ = 0;
  uint32_t mean_ = 0;
  int32_t offset_ = 0;
  int32_t sigma_ = 0;
  Trouble trouble_ = Trouble::not_finished;
};

}  // namespace whisker::planning
