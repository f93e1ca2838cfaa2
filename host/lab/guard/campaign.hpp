/// Many drives of one operator in one class of worlds.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "host/lab/guard/drive.hpp"
#include "host/lab/guard/operators.hpp"

namespace whisker::guard {

struct Ground {
  std::string_view name;  ///< "30 discs" or "75 discs in a box"
  int discs;
  bool box;
};
constexpr Ground kGrounds[] = {{"30 discs", 30, false}, {"75 discs in a box", 75, true}};

/// How the operator's commands reach the wheels.
struct Mode {
  std::string_view name;
  bool guarded = true;
  bool nods = true;
  double vouched_m = 0;
  bool assists = false;
};
constexpr Mode kModes[] = {{"no guard", false, false, 0, false},
                           {"scale only", true, false, 0, false},
                           {"nod", true, true, 0, false},
                           {"nod, start vouched for", true, true, 0.35, false},
                           {"nod and assist", true, true, 0, true}};

struct Summary {
  std::uint64_t drives = 0;  ///< worlds without a path for this operator do not count
  std::uint64_t arrived = 0, contacts = 0, faults = 0, stops = 0;
  double path_m = 0, time_s = 0;
  double granted = 0;  ///< sum of the shares
  double min_clearance_m = 1000;

  void add(const Result& result);
  double speed_mps() const { return time_s > 0 ? path_m / time_s : 0; }
  double mean_granted() const { return drives > 0 ? granted / static_cast<double>(drives) : 0; }
};

struct Plan {
  Hand hand = Hand::perfect;
  Ground ground = kGrounds[0];
  Mode mode = kModes[2];
  Params robot;
  bool noise = false;
  std::uint64_t first_seed = 1;
  std::uint64_t count = 60;
  const fuzzy::Bilinear::Table* table = nullptr;  ///< of the assist; null: the core's own
};

/// Worlds without a path for this operator do not count. Drives without a goal of their own last 20 s, others
/// at most 120 s. Drive i is in the world of seed first_seed + i. `next` is called before each; false ends
/// the campaign.
Summary drive_many(const Plan& plan, const std::function<bool(std::uint64_t)>& next);

/// Up to 20 s of hostile commands in a random world of any class, beginning beside an obstacle, with random
/// accepted gaps between ticks in one drive of three. The same seed gives the same drive. seed < 2^62.
/// `table`: see Options::table.
Result hostile_drive(std::uint64_t seed, bool noise, const Params& robot,
                     const fuzzy::Bilinear::Table* table = nullptr);

}  // namespace whisker::guard
