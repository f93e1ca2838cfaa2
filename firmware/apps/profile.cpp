// Like replay, but counts only the instructions of one part of the core: the local grid, the marking of the
// map's beams, the wavefront, or the inputs of the response table. The linker puts the functions below
// between the part and its callers (--wrap).
#include "firmware/apps/golden/player.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/global/wavefront.hpp"
#include "firmware/planning/ground_inputs.hpp"
#include "hal/board.hpp"

namespace {

/// Replaces the time with the instructions of the part.
class PartMeter final : public whisker::hal::Meter {
 public:
  uint32_t stamp() noexcept override { return 0; }
  uint32_t between(uint32_t, uint32_t) noexcept override {
    const uint32_t passed = passed_;
    passed_ = 0;
    return passed;
  }
  uint32_t deepest_stack() noexcept override { return board().deepest_stack(); }

  static whisker::hal::Meter& board() noexcept { return whisker::hal::board().meter; }
  void add(uint32_t from) noexcept { passed_ += board().between(from, board().stamp()); }

 private:
  uint32_t passed_ = 0;
};

PartMeter meter;

/// Counts from construction to the end of the block.
class Run {
 public:
  Run() noexcept : from_(PartMeter::board().stamp()) {}
  ~Run() { meter.add(from_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

 private:
  uint32_t from_;
};

}  // namespace

#define WHISKER_MEASURED(function, Result, parameters, arguments) \
  extern "C" Result __real_##function parameters noexcept;        \
  extern "C" Result __wrap_##function parameters noexcept {       \
    const Run run;                                                \
    return __real_##function arguments;                           \
  }

using namespace whisker;
using perception::LocalGrid;
using planning::GridMap;
using planning::Wavefront;

#if defined(WHISKER_PROFILE_PATCH)
WHISKER_MEASURED(
    _ZN7whisker10perception9LocalGrid4markERKNS0_15ConeObservationEPKNS0_18EarlierObservationERKNS1_6ApexesE,
    void,
    (LocalGrid * local_grid, const perception::ConeObservation& observation,
     const perception::EarlierObservation* before, const LocalGrid::Apexes& at),
    (local_grid, observation, before, at))
WHISKER_MEASURED(_ZN7whisker10perception9LocalGrid7move_toERKNS_4PoseE, void,
                 (LocalGrid * local_grid, const Pose& pose), (local_grid, pose))
#elif defined(WHISKER_PROFILE_MARKS)
WHISKER_MEASURED(_ZN7whisker8planning7GridMap4markERKNS_10perception15ConeObservationEPKNS1_4HoldEb, int32_t,
                 (GridMap * map, const perception::ConeObservation& observation, const GridMap::Hold* hold,
                  bool doubts),
                 (map, observation, hold, doubts))
#elif defined(WHISKER_PROFILE_FLOOD)
WHISKER_MEASURED(_ZN7whisker8planning9Wavefront3runERNS0_7GridMapElPl, bool,
                 (Wavefront * wavefront, GridMap& map, int32_t words, int32_t* spare),
                 (wavefront, map, words, spare))
#elif defined(WHISKER_PROFILE_INPUTS)
#if defined(__clang__)
#pragma clang diagnostic ignored "-Wreturn-type-c-linkage"
#endif
WHISKER_MEASURED(
    _ZN7whisker8planning13ground_inputsENS_4UnitINS_9LengthTagEEERKNS_10perception9LocalGridENS_3VecENS_5AngleERKNS_6ParamsE,
    fuzzy::Inputs, (Length nearest, const LocalGrid& grid, Vec at, Angle course, const Params& params),
    (nearest, grid, at, course, params))
#endif

int main() { return golden::play(meter); }
