/// A hash of a short drive among every kind of obstacle with every kind of noise: it must be the same with
/// every compiler and optimisation, and in WebAssembly. Includes no library.
#pragma once

#include <stdint.h>

namespace whisker::sim {

/// FNV-1a 64 over every tick's pose bits, wheel speeds' bits, ranges and encoder counts.
uint64_t scripted_drive(uint64_t seed);

}  // namespace whisker::sim
