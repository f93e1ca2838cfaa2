// A program that uses all of whisker::Guard and nothing else: scripts/measure guard measures its size.
#include "firmware/guard.hpp"

namespace {

using namespace whisker::literals;

class Board final : public whisker::hal::Rangefinders, public whisker::hal::Drive {
 public:
  bool read(whisker::hal::RangeReadings& out) noexcept override {
    out = ranges;
    return answers;
  }
  bool read(whisker::hal::EncoderCounts& out) noexcept override {
    out = counts;
    return answers;
  }
  bool command(whisker::hal::WheelSpeeds speeds) noexcept override {
    sent = speeds;
    return answers;
  }

  volatile bool answers = true;
  whisker::hal::RangeReadings ranges{};
  whisker::hal::EncoderCounts counts{};
  whisker::hal::WheelSpeeds sent{};
};

constexpr whisker::Params kParams{};
static_assert(whisker::check(kParams) == whisker::ParamFault::none, "");
Board board;
alignas(whisker::Guard) unsigned char room[sizeof(whisker::Guard)];

}  // namespace

void* operator new(decltype(sizeof(0)), void* place) noexcept { return place; }

extern "C" int main() {
  whisker::Guard& guard = *new (room) whisker::Guard(board, board, kParams);
  guard.vouch(350_mm);
  for (uint32_t ms = 0;; ms += 10) {
    const whisker::Time now = whisker::Time::from_raw(ms);
    guard.command({300_mm_per_s, {}}, now);
    if (guard.tick(now).health.fault != whisker::Fault::none && !board.answers) guard.reset();
  }
}
