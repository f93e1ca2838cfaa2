/// A short drive among every kind of obstacle with every kind of noise, as one number: what must come out the
/// same on every compiler, at every optimisation, and in WebAssembly. It includes no library either.
#pragma once

#include <stdint.h>

namespace whisker::sim {

/// FNV-1a 64 over every tick's pose bits, wheel speeds' bits, ranges and encoder counts.
uint64_t scripted_drive(uint64_t seed);

}  // namespace whisker::sim
