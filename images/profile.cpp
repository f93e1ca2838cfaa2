// Like replay, but an answer's work is that of the clearance patch alone. The linker puts the functions below
// between the robot and the patch (--wrap).
#include "firmware/ground/patch.hpp"
#include "hal/board.hpp"
#include "hal/link/session.hpp"

namespace {

using whisker::ground::Patch;
using whisker::ground::Proof;

/// What passed between two calls of between(), instead of the time.
class PatchMeter final : public whisker::hal::Meter {
 public:
  uint32_t stamp() noexcept override { return 0; }
  uint32_t between(uint32_t, uint32_t) noexcept override {
    const uint32_t passed = passed_;
    passed_ = 0;
    return passed;
  }
  uint32_t deepest_stack() noexcept override { return board().deepest_stack(); }

  template <class F>
  void measure(const F& call) noexcept {
    const uint32_t from = board().stamp();
    call();
    passed_ += board().between(from, board().stamp());
  }

 private:
  static whisker::hal::Meter& board() noexcept { return whisker::hal::board().meter; }
  uint32_t passed_ = 0;
};

PatchMeter meter;

}  // namespace

#define WHISKER_MARK _ZN7whisker6ground5Patch4markERKNS0_5ProofE
#define WHISKER_MOVE _ZN7whisker6ground5Patch7move_toERKNS_4PoseE
#define WHISKER_JOIN(a, b) a##b
#define WHISKER_REAL(name) WHISKER_JOIN(__real_, name)
#define WHISKER_WRAP(name) WHISKER_JOIN(__wrap_, name)

extern "C" {
void WHISKER_REAL(WHISKER_MARK)(Patch* patch, const Proof& proof) noexcept;
void WHISKER_WRAP(WHISKER_MARK)(Patch* patch, const Proof& proof) noexcept;
void WHISKER_REAL(WHISKER_MOVE)(Patch* patch, const whisker::Pose& pose) noexcept;
void WHISKER_WRAP(WHISKER_MOVE)(Patch* patch, const whisker::Pose& pose) noexcept;

void WHISKER_WRAP(WHISKER_MARK)(Patch* patch, const Proof& proof) noexcept {
  meter.measure([&] { WHISKER_REAL(WHISKER_MARK)(patch, proof); });
}
void WHISKER_WRAP(WHISKER_MOVE)(Patch* patch, const whisker::Pose& pose) noexcept {
  meter.measure([&] { WHISKER_REAL(WHISKER_MOVE)(patch, pose); });
}
}

int main() {
  static whisker::link::Session session;
  return session.run(whisker::hal::board().host, meter);
}
