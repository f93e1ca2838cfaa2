/// Keeps the parameters of a board in a storage, so that a loss of power at any instant leaves the old ones
/// or the new ones.
///
/// | bytes | content |
/// |---|---|
/// | 0 | version of the layout: kParamVersion |
/// | 1 | number of parameters |
/// | 2, 3 | sequence number: the record with the later number, modulo 2^16, is the newer |
/// | 4 to 7 | version of the firmware: an index belongs to it |
/// | from 8 | raw values in the order of their indices, 32 bits each |
/// | last 4 | CRC-32 of all bytes before |
///
/// All numbers have their low byte first.
#pragma once

#include <stdint.h>

#include "firmware/params/words.hpp"
#include "firmware/storage/slots.hpp"

namespace whisker::can {

using storage::Stored;

constexpr uint8_t kParamVersion = 1;
constexpr uint16_t kParamRecordBytes = 8 + 4 * kParams + 4;

class ParamStore {
 public:
  /// Must outlive it. With slots smaller than kParamRecordBytes, nothing can be saved. version: of the
  /// firmware; records of another one do not count.
  ParamStore(hal::Storage& storage, uint32_t version) noexcept : storage_(storage), version_(version) {}

  /// The newest undamaged parameters that check() accepts. Unless ok, `params` is unchanged.
  Stored load(Params& params) noexcept;
  /// Writes into the slot that has not the newest ones, and reads it back. Blocks as hal::Storage::erase().
  Stored save(const Params& params) noexcept;

 private:
  storage::Newest newest() noexcept;
  /// Reads the record of a slot. params: null, or set from it.
  storage::Content judge(uint8_t slot, uint16_t& sequence, Params* params) noexcept;

  hal::Storage& storage_;
  const uint32_t version_;
};

}  // namespace whisker::can
