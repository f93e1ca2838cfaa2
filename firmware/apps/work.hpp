/// Prints the cost of many runs of a piece of code on the console.
#pragma once

#include "hal/board.hpp"

namespace whisker::images {

struct Work {
  uint32_t least = UINT32_MAX;
  uint32_t most = 0;
  uint64_t sum = 0;
  uint32_t count = 0;

  void add(uint32_t spent) noexcept {
    if (spent < least) least = spent;
    if (spent > most) most = spent;
    sum += spent;
    ++count;
  }
};

inline void print_number(uint32_t number) noexcept {
  char digits[11];
  char* p = digits + sizeof digits - 1;
  *p = '\0';
  do {
    *--p = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  hal::board().console.print(" ");
  hal::board().console.print(p);
}

/// A line: name, minimum, mean, maximum, each without the cost of the measurement.
inline void print_work(const char* name, const Work& work, uint32_t not_its_own) noexcept {
  hal::board().console.print(name);
  print_number(work.least - not_its_own);
  print_number(static_cast<uint32_t>(work.sum / work.count) - not_its_own);
  print_number(work.most - not_its_own);
  hal::board().console.print("\n");
}

}  // namespace whisker::images
