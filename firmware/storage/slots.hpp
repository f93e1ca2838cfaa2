/// What the users of a hal::Storage share: which of its two records is the newest.
#pragma once

#include <stdint.h>

#include "hal/storage.hpp"

namespace whisker::storage {

/// Result of a load or a save.
enum class Stored : uint8_t {
  ok,
  nothing,        ///< no slot has an undamaged record
  other_version,  ///< the only records are of another layout; a save replaces one of them
  no_answer,      ///< the storage does not answer
  not_written,    ///< the storage failed to write, or reads back other bytes: the old record is still there
};
constexpr int kStoreds = 5;
constexpr const char* name(Stored stored) noexcept {
  switch (stored) {
    case Stored::ok: return "ok";
    case Stored::nothing: return "nothing";
    case Stored::other_version: return "other_version";
    case Stored::no_answer: return "no_answer";
    case Stored::not_written: return "not_written";
  }
  return "?";
}

/// What a slot has.
enum class Content : uint8_t { record, damaged, other_version, no_answer };

struct Newest {
  uint8_t slot = hal::Storage::kSlots - 1;
  uint16_t sequence = 0;
  Stored found = Stored::nothing;

  /// The slot for the next record: not that of the newest.
  uint8_t other() const noexcept { return static_cast<uint8_t>(hal::Storage::kSlots - 1 - slot); }
};

/// Sequence numbers wrap.
constexpr bool later(uint16_t a, uint16_t b) noexcept {
  return static_cast<uint16_t>(a - b - 1) < UINT16_MAX / 2;
}

/// judge(slot, sequence): the content of a slot; sets the sequence number of a record.
template <class Judge>
Newest newest(const Judge& judge) noexcept {
  Newest newest;
  bool answers = false;
  for (uint8_t slot = 0; slot < hal::Storage::kSlots; ++slot) {
    uint16_t sequence = 0;
    const Content content = judge(slot, sequence);
    if (content != Content::no_answer) answers = true;
    if (content == Content::other_version && newest.found == Stored::nothing) {
      newest = {slot, 0, Stored::other_version};
    }
    if (content != Content::record) continue;
    if (newest.found == Stored::ok && !later(sequence, newest.sequence)) continue;
    newest = {slot, sequence, Stored::ok};
  }
  if (!answers) newest.found = Stored::no_answer;
  return newest;
}

}  // namespace whisker::storage
