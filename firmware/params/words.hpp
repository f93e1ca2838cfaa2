/// The parameters by number, each as a raw 32-bit word. The number is the parameter's place in
/// for_each_param. What is derived has a number and no word.
#pragma once

#include <stdint.h>

#include "firmware/params.hpp"

namespace whisker {

struct ParamCounter {
  int counted = 0;
  template <class T>
  constexpr void number(const char*, const T&, T, T) noexcept {
    ++counted;
  }
  constexpr void count(const char*, const int32_t&, int32_t, int32_t) noexcept { ++counted; }
  template <class E>
  constexpr void choice(const char*, const E&, const char* const*, int) noexcept {
    ++counted;
  }
  constexpr void derived(const char*) noexcept { ++counted; }
};
constexpr int count_params() noexcept {
  const Params p{};
  ParamCounter counter;
  for_each_param(p, counter);
  return counter.counted;
}
constexpr int kParams = count_params();

/// 0 <= number < kParams for all four. The robot derives the parameter.
bool is_derived(int number) noexcept;
/// Zero if it is derived.
uint32_t raw_param(const Params& params, int number) noexcept;
/// Takes every value, also one outside the parameter's range. No effect if it is derived.
void set_raw_param(Params& params, int number, uint32_t raw) noexcept;
/// False if it is derived.
bool in_own_range(int number, uint32_t raw) noexcept;

}  // namespace whisker
