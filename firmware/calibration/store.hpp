/// Keeps calibration values in a storage, so that a loss of power at any instant leaves the old ones or the
/// new ones.
#pragma once

#include <stdint.h>

#include "firmware/calibration/record.hpp"
#include "firmware/storage/slots.hpp"

namespace whisker::calibration {

using storage::Stored;

class Store {
 public:
  /// Must outlive it.
  explicit Store(hal::Storage& storage) noexcept : storage_(storage) {}

  /// The newest undamaged values. Unless ok, `values` is unchanged.
  Stored load(Values& values) noexcept;
  /// Writes into the slot that has not the newest values, and reads it back. Blocks as
  /// hal::Storage::erase().
  Stored save(const Values& values) noexcept;

 private:
  /// record: the newest one, if there is one.
  storage::Newest newest(Record& record) noexcept;

  hal::Storage& storage_;
};

/// At the start of a board: writes the stored values into its parameters. False: there are none, or check()
/// refuses them; the parameters are unchanged.
bool apply_stored(hal::Storage& storage, Params& params) noexcept;

}  // namespace whisker::calibration
