#include "firmware/planning/transition.hpp"

#include "firmware/math/assert.hpp"

namespace whisker::planning {

uint8_t next_phase(const uint8_t* rows, size_t count, uint8_t phase, uint8_t event,
                   Decision& decision) noexcept {
  enum Member : uint8_t { from, on, to, mode, why, kMembers };
  const uint8_t* row = rows;
  const uint8_t* const end = rows + count * kMembers;
  while (row != end && (row[from] != phase || row[on] != event)) row += kMembers;
  const bool knows_the_event = row != end;
  WHISKER_ASSERT(knows_the_event);
  if (!knows_the_event) return phase;
  if (row[mode] != static_cast<uint8_t>(Mode::idle)) decision.mode = static_cast<Mode>(row[mode]);
  if (row[why] != static_cast<uint8_t>(Why::none)) decision.why = static_cast<Why>(row[why]);
  return row[to];
}

}  // namespace whisker::planning
