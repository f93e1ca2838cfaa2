/// What the functions that a WebAssembly module exports have in common.
#pragma once

#include <memory>
#include <vector>

#include "host/lab/play/simulated_robot.hpp"

#define WHISKER_EXPORT(NAME) extern "C" [[clang::export_name(#NAME)]]

namespace whisker::play {

constexpr int kSides = 2;

/// The list of exports.cpp.
extern std::vector<double> exchanged;
extern std::unique_ptr<SimulatedRobot> robots[kSides];

}  // namespace whisker::play
