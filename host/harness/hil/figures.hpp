/// Figures of a run on the bus.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/can/base_node.hpp"

namespace whisker::hil {

struct Figures {
  std::uint64_t sets = 0;                     ///< input sets sent, each once
  std::uint64_t resent = 0;                   ///< lockstep: sets sent again
  std::uint64_t misses = 0;                   ///< real time: sets without an answer before the next one
  std::uint64_t late = 0;                     ///< real time: periods that started late on this computer
  std::vector<std::uint32_t> round_trip_us;   ///< from a set to its answer
  can::BusHealth health;                      ///< of the plant's node at the end
  std::uint32_t resumed = 0;                  ///< safe stops after which the mission continued
  std::uint64_t fixes = 0;                    ///< sent, each once
  std::uint64_t fixes_accepted = 0;           ///< of those whose answer arrived
  std::uint64_t fixes_refused = 0;            ///< likewise
  std::optional<can::Calibrated> calibrated;  ///< what a calibration has found
  std::uint64_t frames = 0;                   ///< on the bus, as seen by this side
  std::uint64_t bits = 0;                     ///< of these frames, upper bound
  double wall_s = 0;                          ///< from the first tick until now
  double run_s = 0;                           ///< the same in the robot's time: ticks times period
};

/// One JSON object without a newline. bitrate: of the bus for which the load is reported.
std::string figures_json(const Figures& figures, double bitrate);
/// A short text for people.
std::string figures_words(const Figures& figures, double bitrate);

/// The value that this share of the samples does not exceed; 0 without samples. part: 0..1.
std::uint32_t percentile(std::vector<std::uint32_t> samples, double part);

}  // namespace whisker::hil
