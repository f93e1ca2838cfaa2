#pragma once

#include <stdint.h>

#include "firmware/can/messages.hpp"
#include "firmware/fuzzy/digest.hpp"

namespace whisker::can {

/// The response table of a controller: the built-in one, or one that its base sent.
///
/// A table arrives in memory that is not in use, and is activated as a whole, by its hash. With one room, a
/// new table overwrites the one before, so its first part activates the built-in table.
class RulesServer {
 public:
  using Table = fuzzy::Bilinear::Table;

  RulesServer(const RulesServer&) = delete;
  RulesServer& operator=(const RulesServer&) = delete;

  /// Activates the table that the storage has. Unless ok, the built-in table remains active.
  fuzzy::Stored load() noexcept;

  /// Lives as long as the server; it keeps its values until another table is active.
  const Table& active() const noexcept { return *active_; }
  uint32_t hash() const noexcept { return hash_; }

  /// Only while the robot stands. The reply is sent if ends_block(part).
  RulesReply take(const RulesPart& part) noexcept;
  /// Only while the robot stands. Blocks as hal::Storage::erase() if there is a storage. An order with the
  /// upload number of one that could not be kept is a repetition, and does not try again.
  RulesReply execute(const RulesOrder& order) noexcept;
  /// The parts that have arrived are void.
  void forget() noexcept {
    begun_ = false;
    tried_ = false;
  }

 protected:
  /// built_in, rooms and store must outlive it. rooms: one or two; they may be constructed later.
  RulesServer(const Table& built_in, Table* rooms, uint8_t count, fuzzy::TableStore* store) noexcept
      : built_in_(built_in),
        rooms_(rooms),
        count_(count),
        store_(store),
        built_in_hash_(fuzzy::digest(built_in)),
        active_(&built_in),
        hash_(built_in_hash_) {}
  ~RulesServer() = default;

 private:
  Table& room() noexcept { return rooms_[count_ > 1 && active_ == rooms_ ? 1 : 0]; }
  void activate(const Table& table) noexcept;
  void keep(uint8_t upload) noexcept;
  RulesReply reply(RulesStatus status, uint8_t upload) const noexcept;

  const Table& built_in_;
  Table* const rooms_;
  const uint8_t count_;
  fuzzy::TableStore* const store_;
  const uint32_t built_in_hash_;
  const Table* active_;
  uint32_t hash_;
  uint16_t next_ = 0;  // first node that is missing
  uint8_t upload_ = 0;
  bool begun_ = false;  // upload_ and next_ belong to a base's table
  bool kept_ = false;   // the storage has the active table
  bool tried_ = false;  // to keep it, for an order with the number tried_for_
  uint8_t tried_for_ = 0;
};

/// With memory for one table or two: 7,524 bytes each.
template <uint8_t kRooms>
class RulesServerWith final : public RulesServer {
 public:
  static_assert(kRooms == 1 || kRooms == 2);
  explicit RulesServerWith(const Table& built_in, fuzzy::TableStore* store = nullptr) noexcept
      : RulesServer(built_in, rooms_, kRooms, store) {}

 private:
  Table rooms_[kRooms] = {};
};

}  // namespace whisker::can
