#include "firmware/calibration/store.hpp"

namespace whisker::calibration {
namespace {

storage::Content content_of(Decoded decoded) noexcept {
  switch (decoded) {
    case Decoded::ok: return storage::Content::record;
    case Decoded::damaged: return storage::Content::damaged;
    case Decoded::other_version: return storage::Content::other_version;
  }
  return storage::Content::damaged;
}

}  // namespace

storage::Newest Store::newest(Record& record) noexcept {
  Record read[hal::Storage::kSlots];
  const storage::Newest newest = storage::newest([&](uint8_t slot, uint16_t& sequence) {
    uint8_t bytes[hal::Storage::kSlotBytes];
    if (!storage_.read(slot, 0, bytes, sizeof bytes)) return storage::Content::no_answer;
    const Decoded decoded = decode(bytes, sizeof bytes, read[slot]);
    sequence = read[slot].sequence;
    return content_of(decoded);
  });
  if (newest.found == Stored::ok) record = read[newest.slot];
  return newest;
}

Stored Store::load(Values& values) noexcept {
  Record record;
  const Stored found = newest(record).found;
  if (found == Stored::ok) values = record.values;
  return found;
}

Stored Store::save(const Values& values) noexcept {
  Record record;
  const storage::Newest old = newest(record);
  if (old.found == Stored::no_answer) return Stored::no_answer;
  record.values = values;
  record.sequence = static_cast<uint16_t>(old.sequence + 1);
  uint8_t bytes[kRecordBytes];
  encode(record, bytes);
  if (!storage_.erase(old.other()) || !storage_.write(old.other(), 0, bytes, kRecordBytes)) {
    return Stored::not_written;
  }
  uint8_t back[kRecordBytes];
  if (!storage_.read(old.other(), 0, back, kRecordBytes)) return Stored::not_written;
  for (uint8_t i = 0; i < kRecordBytes; ++i) {
    if (back[i] != bytes[i]) return Stored::not_written;
  }
  return Stored::ok;
}

bool apply_stored(hal::Storage& storage, Params& params) noexcept {
  Values values;
  return Store(storage).load(values) == Stored::ok && apply(values, params) == ParamFault::none;
}

}  // namespace whisker::calibration
