#include "hal/boards/stm32f405/flash_storage.hpp"

#include "hal/boards/common/patience.hpp"
#include "hal/boards/stm32f405/reg/bases.hpp"
#include "hal/boards/stm32f405/reg/flash.hpp"

namespace whisker::hal::stm32f405 {
namespace {

constexpr Address kSector5 = 0x08020000;  // it and all later ones have this size
constexpr Address kSectorBytes = 0x20000;
constexpr uint32_t key(uint16_t high, uint16_t low) noexcept { return uint32_t{high} << 16 | low; }
constexpr uint32_t kFirstKey = key(0x4567, 0x0123), kSecondKey = key(0xCDEF, 0x89AB);
constexpr uint32_t kByWords = 2;  // PSIZE
constexpr uint32_t kFastest = 168000000;
constexpr uint32_t kEraseUs = 4000000, kWordUs = 1000;
constexpr uint32_t kErrors =
    mask(flash::kWrperr) | mask(flash::kPgaerr) | mask(flash::kPgperr) | mask(flash::kPgserr);

constexpr bool inside(uint8_t slot, uint16_t at, uint16_t size) noexcept {
  return slot < Storage::kSlots && at <= FlashStorage::kSize && size <= FlashStorage::kSize - at;
}

constexpr Address place(uint32_t sector, uint16_t at) noexcept {
  return kSector5 + (sector - 5) * kSectorBytes + at;
}

/// The flash accepts commands while this lives.
class Unlocked {
 public:
  Unlocked() noexcept {
    if (is_set(base::kFlash, flash::kLock)) {
      store(base::kFlash, flash::kKeyr, kFirstKey);
      store(base::kFlash, flash::kKeyr, kSecondKey);
    }
    store(base::kFlash, flash::kSr, kErrors);
  }
  /// The data cache may have the old bytes.
  ~Unlocked() {
    store(base::kFlash, flash::kCr, mask(flash::kLock));
    set(base::kFlash, flash::kDcen, 0);
    set(base::kFlash, flash::kDcrst, 1);
    set(base::kFlash, flash::kDcrst, 0);
    set(base::kFlash, flash::kDcen, 1);
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
};

bool done(uint32_t within_us) noexcept {
  Patience patience = Patience::for_us(within_us, kFastest);
  return patience.until(base::kFlash, flash::kBsy, false) && (load(base::kFlash, flash::kSr) & kErrors) == 0;
}

}  // namespace

bool FlashStorage::read(uint8_t slot, uint16_t at, uint8_t* out, uint16_t size) noexcept {
  if (!inside(slot, at, size)) return false;
  for (uint16_t i = 0; i < size; ++i) {
    const Address byte = place(first_sector_ + slot, at) + i;
    out[i] = static_cast<uint8_t>(load(byte & ~Address{3}) >> (8 * (byte & 3)));
  }
  return true;
}

bool FlashStorage::erase(uint8_t slot) noexcept {
  if (!inside(slot, 0, 0)) return false;
  const Unlocked unlocked;
  if (!done(kEraseUs)) return false;
  const uint32_t command =
      bits(flash::kPsize, kByWords) | mask(flash::kSer) | bits(flash::kSnb, first_sector_ + slot);
  store(base::kFlash, flash::kCr, command);
  store(base::kFlash, flash::kCr, command | mask(flash::kStrt));
  return done(kEraseUs);
}

bool FlashStorage::write(uint8_t slot, uint16_t at, const uint8_t* data, uint16_t size) noexcept {
  if (!inside(slot, at, size) || at % kGrain != 0 || size % kGrain != 0) return false;
  const Unlocked unlocked;
  if (!done(kEraseUs)) return false;
  store(base::kFlash, flash::kCr, bits(flash::kPsize, kByWords) | mask(flash::kPg));
  for (uint16_t i = 0; i < size; i = static_cast<uint16_t>(i + kGrain)) {
    uint32_t word = 0;
    for (uint16_t b = 0; b < kGrain; ++b) word |= uint32_t{data[i + b]} << (8 * b);
    store(place(first_sector_ + slot, at) + i, word);
    if (!done(kWordUs)) return false;
  }
  return true;
}

}  // namespace whisker::hal::stm32f405
