// Evaluates every input that the look-up distinguishes, and some far outside; prints a hash of the answers.
#include "firmware/fuzzy/response_table.hpp"
#include "hal/board.hpp"

using namespace whisker;

namespace {

constexpr int32_t kBeyond = 40;
constexpr int16_t kExtremes[] = {INT16_MIN, INT16_MIN + 1, -4096, 4096, INT16_MAX - 1, INT16_MAX};

/// FNV-1a, one word at a time.
class Hash {
 public:
  void add(uint32_t word) noexcept { value_ = (value_ ^ word) * 16777619U; }
  void print() const noexcept {
    char text[] = "00000000\n";
    for (int i = 0; i < 8; ++i) text[i] = "0123456789abcdef"[(value_ >> (28 - 4 * i)) & 15U];
    hal::board().console.print(text);
  }

 private:
  uint32_t value_ = 2166136261U;
};

class Sweep {
 public:
  void all() noexcept {
    for (int32_t d = kDistanceFirst; d <= kDistanceLast; ++d) row(d);
    for (const int16_t d : kExtremes) row(d);
  }
  const Hash& hash() const noexcept { return hash_; }

 private:
  static constexpr int32_t kDistanceFirst = fuzzy::kDistanceLow - kBeyond;
  static constexpr int32_t kDistanceLast = fuzzy::kDistanceLow + fuzzy::kDistanceSpan + kBeyond;
  static constexpr int32_t kBiasFirst = fuzzy::kBiasLow - kBeyond;
  static constexpr int32_t kBiasLast = fuzzy::kBiasLow + fuzzy::kBiasSpan + kBeyond;

  void row(int32_t d) noexcept {
    for (int32_t r = kBiasFirst; r <= kBiasLast; ++r) answer(d, r);
    for (const int16_t r : kExtremes) answer(d, r);
  }
  void answer(int32_t d, int32_t r) noexcept {
    const fuzzy::Response out =
        look_up_({Q7::from_raw(static_cast<int16_t>(d)), Q7::from_raw(static_cast<int16_t>(r))});
    hash_.add(static_cast<uint16_t>(out.turn.raw()) |
              static_cast<uint32_t>(static_cast<uint16_t>(out.step.raw())) << 16);
    hash_.add(out.cell.distance | static_cast<uint32_t>(out.cell.bias) << 16);
  }

  fuzzy::Bilinear look_up_{fuzzy::kResponseTable};
  Hash hash_;
};

}  // namespace

int main() {
  Sweep sweep;
  sweep.all();
  sweep.hash().print();
  return 0;
}
