// Like replay, but an answer's work is that of one part of the core alone: the clearance patch, what the
// map's beams mark, or the flood upon it. The linker puts the functions below between the part and who calls
// it (--wrap).
#include "firmware/ground/patch.hpp"
#include "firmware/map/flood.hpp"
#include "hal/board.hpp"
#include "hal/link/session.hpp"

namespace {

/// What passed while the part ran, instead of the time.
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

/// Of the part, from here to the end of the block.
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
using ground::Patch;
using map::Flood;
using map::Map;

#if defined(WHISKER_PROFILE_PATCH)
WHISKER_MEASURED(_ZN7whisker6ground5Patch4markERKNS0_5ProofEPKNS0_7EarlierE, void,
                 (Patch * patch, const ground::Proof& proof, const ground::Earlier* before),
                 (patch, proof, before))
WHISKER_MEASURED(_ZN7whisker6ground5Patch7move_toERKNS_4PoseE, void, (Patch * patch, const Pose& pose),
                 (patch, pose))
#elif defined(WHISKER_PROFILE_MARKS)
WHISKER_MEASURED(_ZN7whisker3map3Map4markERKNS_6ground5ProofEb, void,
                 (Map * map, const ground::Proof& proof, bool hold), (map, proof, hold))
#elif defined(WHISKER_PROFILE_FLOOD)
WHISKER_MEASURED(_ZN7whisker3map5Flood3runERNS0_3MapEl, bool, (Flood * flood, Map& map, int32_t words),
                 (flood, map, words))
#endif

int main() {
  static link::Session session;
  return session.run(hal::board().host, meter);
}
