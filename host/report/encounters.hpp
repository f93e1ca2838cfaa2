/// Where the robot met an obstacle, and where it went for the goal again.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/run/record.hpp"

namespace whisker::report {

/// From the tick at which the way to the goal was found blocked to the tick at which the robot left the
/// obstacle's edge. Records without a place that can be drawn are passed over.
struct Encounter {
  enum class End {
    none,         ///< the run ended at the edge
    left,         ///< towards the goal, or it is there
    wall_lost,    ///< went round something else than what it met
    unreachable,  ///< came round: the verdict
  };
  const TickRecord* hit;
  const TickRecord* turned = nullptr;  ///< where it came round the first time and went on the other way
  const TickRecord* left = nullptr;    ///< null with End::none
  End end = End::none;
};

/// Finds them while the run goes on; a record goes by its number.
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

}  // namespace whisker::report
