#include "firmware/params/words.hpp"

#include <stddef.h>

#include "firmware/params/relations.hpp"

namespace whisker {
namespace {

constexpr int kWordsOfParams = sizeof(Params) / sizeof(uint32_t);
constexpr uint8_t kNowhere = 255;

// One table is smaller than a visitor's code for each parameter.
struct Word {
  uint8_t at = kNowhere;  // place in Params
  uint32_t low = 0;
  uint32_t span = 0;  // of the accepted values, signed or not, from the lowest up
};
struct Words {
  Word of[kParams];
};
struct Raw {
  uint32_t of[kWordsOfParams];
};

// Writes each parameter's number into the parameter, and its range into the table.
struct Numberer {
  Words words{};
  int next = 0;
  int fields = 0;

  template <class T>
  constexpr void number(const char*, T& field, T low, T high) noexcept {
    field = T::from_raw(static_cast<decltype(field.raw())>(next));
    add(static_cast<uint32_t>(low.raw()), static_cast<uint32_t>(high.raw()));
  }
  constexpr void count(const char*, int32_t& field, int32_t low, int32_t high) noexcept {
    field = next;
    add(static_cast<uint32_t>(low), static_cast<uint32_t>(high));
  }
  template <class E>
  constexpr void choice(const char*, E& field, const char* const*, int names) noexcept {
    field = static_cast<E>(next);
    add(0, static_cast<uint32_t>(names - 1));
  }
  constexpr void derived(const char*) noexcept { ++next; }
  constexpr void add(uint32_t low, uint32_t high) noexcept {
    words.of[next].low = low;
    words.of[next++].span = high - low;
    ++fields;
  }
};

constexpr Numberer number_params() noexcept {
  Params p{};
  Numberer numberer;
  for_each_param(p, numberer);
  const Raw raw = __builtin_bit_cast(Raw, p);
  for (int at = 0; at < kWordsOfParams; ++at) numberer.words.of[raw.of[at]].at = static_cast<uint8_t>(at);
  return numberer;
}
static_assert(number_params().fields == kWordsOfParams, "every word is a parameter");
constexpr Words kWords = number_params().words;

constexpr ptrdiff_t place_of(int number) noexcept { return ptrdiff_t{4} * kWords.of[number].at; }

}  // namespace

bool is_derived(int number) noexcept { return kWords.of[number].at == kNowhere; }

uint32_t raw_param(const Params& params, int number) noexcept {
  if (is_derived(number)) return 0;
  uint32_t raw = 0;
  __builtin_memcpy(&raw, reinterpret_cast<const unsigned char*>(&params) + place_of(number), 4);
  return raw;
}

void set_raw_param(Params& params, int number, uint32_t raw) noexcept {
  if (is_derived(number)) return;
  __builtin_memcpy(reinterpret_cast<unsigned char*>(&params) + place_of(number), &raw, 4);
}

bool in_own_range(int number, uint32_t raw) noexcept {
  return !is_derived(number) && raw - kWords.of[number].low <= kWords.of[number].span;
}

bool at_run_time::in_range(const Params& params) noexcept {
  for (int i = 0; i < kParams; ++i) {
    if (!is_derived(i) && !in_own_range(i, raw_param(params, i))) return false;
  }
  return true;
}

}  // namespace whisker
