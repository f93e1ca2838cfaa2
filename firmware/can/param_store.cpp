#include "firmware/can/param_store.hpp"

#include <stddef.h>

#include "firmware/can/param_server.hpp"
#include "firmware/params/words.hpp"
#include "firmware/storage/words.hpp"

namespace whisker::can {
namespace {

using storage::Content;

constexpr uint16_t kHeaderWords = 2;
constexpr uint16_t kWords = kParamRecordBytes / 4;
constexpr uint16_t kSum = kWords - 1;

constexpr uint32_t header(uint16_t sequence) noexcept {
  return kParamVersion | uint32_t{kParams} << 8 | uint32_t{sequence} << 16;
}

}  // namespace

Content ParamStore::judge(uint8_t slot, uint16_t& sequence, Params* params) noexcept {
  Crc32 sum;
  uint32_t word = 0;
  uint32_t first = 0;
  uint32_t version = 0;
  Params found;
  bool in_range = true;
  for (uint16_t i = 0; i < kSum; ++i) {
    if (!storage::read_word(storage_, slot, i, word)) return Content::no_answer;
    storage::add_word(sum, word);
    if (i == 0) first = word;
    if (i == 1) version = word;
    if (i < kHeaderWords) continue;
    const auto index = static_cast<uint8_t>(i - kHeaderWords);
    if (is_derived(index)) continue;
    in_range = write_param(found, index, word) == ParamStatus::ok && in_range;
  }
  if (!storage::read_word(storage_, slot, kSum, word)) return Content::no_answer;
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
  Crc32 sum;
  const auto add = [&](uint16_t at, uint32_t word) {
    storage::put_word(&bytes[size_t{4} * at], word);
    storage::add_word(sum, word);
  };
  add(0, header(sequence));
  add(1, version_);
  for (uint8_t i = 0; i < kParams; ++i) {
    uint32_t raw = 0;
    read_param(params, i, raw);
    add(static_cast<uint16_t>(kHeaderWords + i), raw);
  }
  storage::put_word(&bytes[size_t{4} * kSum], sum.value());
  if (!storage_.erase(slot) || !storage_.write(slot, 0, bytes, sizeof bytes)) return Stored::not_written;
  uint16_t written = 0;
  return judge(slot, written, nullptr) == Content::record && written == sequence ? Stored::ok
                                                                                 : Stored::not_written;
}

}  // namespace whisker::can
