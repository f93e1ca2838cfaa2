/// Hit and leave points of a run.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/harness/run/record.hpp"

namespace whisker::report {

/// From the tick at which the path to the goal was blocked to the tick at which the robot left the boundary.
/// Records without a drawable position are ignored.
struct Encounter {
  enum class End {
    none,         ///< the run ended at the boundary
    left,         ///< towards the goal, or at the goal
    wall_lost,    ///< the robot circled an obstacle that it did not hit
    unreachable,  ///< loop completed: the verdict
  };
  const TickRecord* hit;
  const TickRecord* turned = nullptr;  ///< where it completed the first loop and reversed the direction
  const TickRecord* left = nullptr;    ///< null with End::none
  End end = End::none;
};

/// Finds them during the run; a record is referred to by its number.
class EncounterFinder {
 public:
  struct Found {
    std::size_t hit;
    std::optional<std::size_t> turned;
    std::optional<std::size_t> left;
    Encounter::End end = Encounter::End::none;
  };

  /// The next record.
  void add(const TickRecord& record);
  const std::vector<Found>& found() const { return found_; }

 private:
  std::vector<Found> found_;
  std::size_t count_ = 0;
  bool inside_ = false;
};

/// In the order of the run; they point into `records`.
std::vector<Encounter> encounters(const std::vector<TickRecord>& records);

struct HandOver {
  const TickRecord* at;
  bool to_edges;  ///< false: back to the map
};

/// Alternating, fallbacks first. None before the map has led for the first time.
std::vector<HandOver> hand_overs(const std::vector<TickRecord>& records);

}  // namespace whisker::report
