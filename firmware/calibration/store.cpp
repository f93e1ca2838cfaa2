#include "firmware/calibration/store.hpp"

namespace whisker::calibration {
namespace {

bool later(uint16_t a, uint16_t b) noexcept { return static_cast<uint16_t>(a - b - 1) < UINT16_MAX / 2; }

}  // namespace

const char* name(Stored stored) noexcept {
  switch (stored) {
    case Stored::ok: return "ok";
    case Stored::nothing: return "nothing";
    case Stored::other_version: return "other_version";
    case Stored::no_answer: return "no_answer";
    case Stored::not_written: return "not_written";
  }
  return "?";
}

Store::Newest Store::newest() noexcept {
  Newest newest;
  uint8_t bytes[hal::Storage::kSlotBytes];
  bool answers = false;
  for (uint8_t slot = 0; slot < hal::Storage::kSlots; ++slot) {
    if (!storage_.read(slot, bytes, sizeof bytes)) continue;
    answers = true;
    Record record;
    const Decoded decoded = decode(bytes, sizeof bytes, record);
    if (decoded == Decoded::other_version && newest.found == Stored::nothing) {
      newest.found = Stored::other_version;
      newest.slot = slot;
    }
    if (decoded != Decoded::ok) continue;
    if (newest.found == Stored::ok && !later(record.sequence, newest.record.sequence)) continue;
    newest = {record, slot, Stored::ok};
  }
  if (!answers) newest.found = Stored::no_answer;
  return newest;
}

Stored Store::load(Values& values) noexcept {
  const Newest found = newest();
  if (found.found == Stored::ok) values = found.record.values;
  return found.found;
}

Stored Store::save(const Values& values) noexcept {
  const Newest old = newest();
  if (old.found == Stored::no_answer) return Stored::no_answer;
  Record record;
  record.values = values;
  record.sequence = static_cast<uint16_t>(old.record.sequence + 1);
  const uint8_t slot = static_cast<uint8_t>(hal::Storage::kSlots - 1 - old.slot);
  uint8_t bytes[kRecordBytes];
  encode(record, bytes);
  if (!storage_.write(slot, bytes, kRecordBytes)) return Stored::not_written;
  uint8_t back[kRecordBytes];
  if (!storage_.read(slot, back, kRecordBytes)) return Stored::not_written;
  for (uint8_t i = 0; i < kRecordBytes; ++i) {
    if (back[i] != bytes[i]) return Stored::not_written;
  }
  return Stored::ok;
}

}  // namespace whisker::calibration
