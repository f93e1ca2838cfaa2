#include "firmware/can/param_store.hpp"

#include "firmware/can/param_server.hpp"
#include "firmware/math/crc32.hpp"

namespace whisker::can {
namespace {

using storage::Content;

constexpr uint16_t kHeaderWords = 2;
constexpr uint16_t kWords = kParamRecordBytes / 4;
constexpr uint16_t kSum = kWords - 1;

constexpr uint32_t header(uint16_t sequence) noexcept {
  return kParamVersion | uint32_t{kParams} << 8 | uint32_t{sequence} << 16;
}

class Sum {
 public:
  void add(uint32_t word) noexcept {
    for (int shift = 0; shift < 32; shift += 8) crc_.add(static_cast<uint8_t>(word >> shift));
  }
  uint32_t value() const noexcept { return crc_.value(); }

 private:
  Crc32 crc_;
};

void put(uint8_t (&record)[kParamRecordBytes], uint16_t at, uint32_t word) noexcept {
  for (uint16_t i = 0; i < 4; ++i) record[4U * at + i] = static_cast<uint8_t>(word >> (8U * i));
}

}  // namespace

bool ParamStore::read(uint8_t slot, uint16_t word, uint32_t& value) noexcept {
  uint8_t bytes[4];
  if (!storage_.read(slot, static_cast<uint16_t>(4 * word), bytes, sizeof bytes)) return false;
  value = bytes[0] | uint32_t{bytes[1]} << 8 | uint32_t{bytes[2]} << 16 | uint32_t{bytes[3]} << 24;
  return true;
}

Content ParamStore::judge(uint8_t slot, uint16_t& sequence, Params* params) noexcept {
  Sum sum;
  uint32_t word = 0;
  uint32_t first = 0;
  uint32_t version = 0;
  Params found;
  bool in_range = true;
  for (uint16_t i = 0; i < kSum; ++i) {
    if (!read(slot, i, word)) return Content::no_answer;
    sum.add(word);
    if (i == 0) first = word;
    if (i == 1) version = word;
    if (i < kHeaderWords) continue;
    const auto index = static_cast<uint8_t>(i - kHeaderWords);
    in_range = write_param(found, index, word) == ParamStatus::ok && in_range;
  }
  if (!read(slot, kSum, word)) return Content::no_answer;
  if (word != sum.value()) return Content::damaged;
  sequence = static_cast<uint16_t>(first >> 16);
  if (first != header(sequence) || version != version_) return Content::other_version;
  if (!in_range || check(found) != ParamFault::none) return Content::other_version;
  if (params != nullptr) *params = found;
  return Content::record;
}

storage::Newest ParamStore::newest() noexcept {
  return storage::newest([this](uint8_t slot, uint16_t& sequence) { return judge(slot, sequence, nullptr); });
}

Stored ParamStore::load(Params& params) noexcept {
  const storage::Newest last = newest();
  if (last.found != Stored::ok) return last.found;
  uint16_t sequence = 0;
  return judge(last.slot, sequence, &params) == Content::record ? Stored::ok : Stored::no_answer;
}

Stored ParamStore::save(const Params& params) noexcept {
  if (storage_.size() < kParamRecordBytes) return Stored::not_written;
  const storage::Newest last = newest();
  const auto sequence = static_cast<uint16_t>(last.sequence + 1);
  const uint8_t slot = last.other();
  uint8_t bytes[kParamRecordBytes];
  Sum sum;
  const auto add = [&](uint16_t at, uint32_t word) {
    put(bytes, at, word);
    sum.add(word);
  };
  add(0, header(sequence));
  add(1, version_);
  for (uint8_t i = 0; i < kParams; ++i) {
    uint32_t raw = 0;
    read_param(params, i, raw);
    add(static_cast<uint16_t>(kHeaderWords + i), raw);
  }
  put(bytes, kSum, sum.value());
  if (!storage_.erase(slot) || !storage_.write(slot, 0, bytes, sizeof bytes)) return Stored::not_written;
  uint16_t written = 0;
  return judge(slot, written, nullptr) == Content::record && written == sequence ? Stored::ok
                                                                                 : Stored::not_written;
}

}  // namespace whisker::can
