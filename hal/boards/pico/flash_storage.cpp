#include "hal/boards/pico/flash_storage.hpp"

#include "hal/boards/pico/interrupts.hpp"
#include "hal/boards/pico/reg/ssi.hpp"

/// Of the linker script: address 0.
extern "C" const uint8_t __boot_rom[];

namespace whisker::hal::pico {
namespace {

constexpr uint32_t kFlash = 0x10000000;
constexpr uint32_t kBytes = 2 * 1024 * 1024;
constexpr uint32_t kSectorBytes = 4096;
constexpr uint32_t kPageBytes = 256;
constexpr uint32_t kBoot2Words = 64;
constexpr uint32_t kErasureMs = 2000;
constexpr uint32_t kBlockBytes = 65536;
constexpr uint8_t kEraseBlock = 0xD8;
// W25Q16JV data sheet, 8.2.35: four bytes of pause, then the number.
constexpr uint8_t kReadId = 0x4B;
constexpr uint8_t kBeforeId = 5;
constexpr uint32_t kBytePolls = 1000;

constexpr bool inside(uint8_t slot, uint16_t at, uint16_t size) noexcept {
  return slot < Storage::kSlots && at <= FlashStorage::kSize && size <= FlashStorage::kSize - at;
}

/// From the start of the flash.
constexpr uint32_t place(FlashUse use, uint8_t slot, uint16_t at) noexcept {
  const uint32_t first = kBytes - kFlashUses * Storage::kSlots * FlashStorage::kSize;
  return first + (static_cast<uint32_t>(use) * Storage::kSlots + slot) * FlashStorage::kSize + at;
}

// Functions of the boot ROM: RP2040 data sheet, 2.8.3.1.3.
struct Rom {
  void (*connect)() noexcept;
  void (*exit_reads)() noexcept;
  void (*erase)(uint32_t at, uint32_t count, uint32_t block, uint8_t command) noexcept;
  void (*program)(uint32_t at, const uint8_t* data, uint32_t count) noexcept;
  void (*flush_cache)() noexcept;
};

constexpr uint32_t code(char first, char second) noexcept {
  return static_cast<uint8_t>(first) | uint32_t{static_cast<uint8_t>(second)} << 8;
}

template <class Function>
void look_up(Function& function, uint32_t which) noexcept {
  using LookUp = Function (*)(const uint16_t* table, uint32_t which);
  const auto half = [](uint32_t at) {
    return uint32_t{*reinterpret_cast<const volatile uint16_t*>(__boot_rom + at)};
  };
  const auto look = reinterpret_cast<LookUp>(half(0x18));
  function = look(reinterpret_cast<const uint16_t*>(half(0x14)), which);
}

Rom rom() noexcept {
  Rom rom{};
  look_up(rom.connect, code('I', 'F'));
  look_up(rom.exit_reads, code('E', 'X'));
  look_up(rom.erase, code('R', 'E'));
  look_up(rom.program, code('R', 'P'));
  look_up(rom.flush_cache, code('F', 'C'));
  return rom;
}

/// What is done to the flash while it cannot be read: `id` is read, or `data` written; without both, it is
/// erased.
struct Work {
  uint32_t at;
  const uint8_t* data;
  uint8_t* id;
};

/// All bytes fit into the queues of the interface, so that the flash stays selected from the first to the
/// last.
[[gnu::always_inline]] inline void ask_id(uint8_t* id) noexcept {
  constexpr uint8_t kAll = kBeforeId + FlashStorage::kIdBytes;
  for (uint8_t i = 0; i < kAll; ++i) store(base::kSsi, ssi::kDr0, i == 0 ? kReadId : 0);
  for (uint8_t i = 0; i < kAll; ++i) {
    for (uint32_t polls = kBytePolls; polls > 0 && !is_set(base::kSsi, ssi::kRfne);) --polls;
    const uint32_t byte = load(base::kSsi, ssi::kDr0);
    if (i >= kBeforeId) id[i - kBeforeId] = static_cast<uint8_t>(byte);
  }
}

/// Runs in the RAM, as does the copy of the second-stage bootloader that makes the flash readable again.
[[gnu::section(".ram_code"), gnu::noinline]] void work_on_flash(const Rom& rom, const Work& work,
                                                                void (*make_readable)()) noexcept {
  rom.connect();
  rom.exit_reads();
  if (work.id != nullptr) {
    ask_id(work.id);
  } else if (work.data == nullptr) {
    rom.erase(work.at, FlashStorage::kSize, kBlockBytes, kEraseBlock);
  } else {
    rom.program(work.at, work.data, kPageBytes);
  }
  rom.flush_cache();
  make_readable();
}

void do_work(const Work& work) noexcept {
  static uint32_t boot2[kBoot2Words];
  for (uint32_t i = 0; i < kBoot2Words; ++i) boot2[i] = reinterpret_cast<const volatile uint32_t*>(kFlash)[i];
  const Rom functions = rom();
  const auto make_readable = reinterpret_cast<void (*)()>(reinterpret_cast<uintptr_t>(boot2) | 1U);
  const Uninterrupted uninterrupted;
  work_on_flash(functions, work, make_readable);
}

}  // namespace

void FlashStorage::read_id(uint8_t (&id)[kIdBytes]) noexcept { do_work({0, nullptr, id}); }

bool FlashStorage::read(uint8_t slot, uint16_t at, uint8_t* out, uint16_t size) noexcept {
  if (!inside(slot, at, size)) return false;
  const auto* from = reinterpret_cast<const volatile uint8_t*>(kFlash + place(use_, slot, at));
  for (uint16_t i = 0; i < size; ++i) out[i] = from[i];
  return true;
}

bool FlashStorage::erase(uint8_t slot) noexcept {
  if (!inside(slot, 0, 0)) return false;
  if (watchdog_ms_ != 0) watchdog_.start(kErasureMs);
  do_work({place(use_, slot, 0), nullptr, nullptr});
  if (watchdog_ms_ != 0) watchdog_.start(watchdog_ms_);
  return true;
}

/// Programming only clears bits, so a page is written with ones wherever it keeps what it has.
bool FlashStorage::write(uint8_t slot, uint16_t at, const uint8_t* data, uint16_t size) noexcept {
  if (!inside(slot, at, size) || at % kGrain != 0 || size % kGrain != 0) return false;
  for (uint16_t done = 0; done < size;) {
    static uint8_t page[kPageBytes];
    for (uint8_t& byte : page) byte = UINT8_MAX;
    const uint32_t to = place(use_, slot, static_cast<uint16_t>(at + done));
    for (uint32_t i = to % kPageBytes; i < kPageBytes && done < size; ++i) page[i] = data[done++];
    if (watchdog_ms_ != 0) watchdog_.feed();
    do_work({to - to % kPageBytes, page, nullptr});
  }
  return true;
}

}  // namespace whisker::hal::pico
