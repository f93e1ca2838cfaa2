/// The verdict of a run, for programs and for people.
#pragma once

#include <cstdint>
#include <string>

#include "host/harness/run/record.hpp"
#include "host/harness/scenario/scenario.hpp"

namespace whisker::report {

/// reached | off_goal | unreachable | gave_up | contact | fault
const char* outcome(Verdict verdict) noexcept;

/// One JSON object on one line, without a final newline. Lengths and times are rounded to 1e-6. A number that
/// is not finite (the clearance in an empty world) or unknown becomes null. bus: a JSON object for the key
/// "bus"; "" for none. `said`: the outcome where there is no verdict yet; null: the verdict. The key
/// "unreachable_above_m" stands only in an unreachable verdict.
std::string result_json(const RunResult& result, const std::string& bus = "", const char* said = nullptr);

/// The figures of RangeTrust in the units of the JSON object.
double contradictions_per_m(const RangeTrust& ranges);
double share(std::uint16_t part);
/// What is wrong with the rangefinders, its figure, and what in the scenario may cause it; "" while they are
/// trusted.
std::string range_warning(const RangeTrust& ranges, const Scenario& scenario);

/// ", within 0.08 m (2 sigma)" after a verdict that the goal is reached, and whether that is more than the
/// tolerance of the goal; "" without a bound.
std::string bound_words(const RunResult& result);

/// "reached in 48.2 s, 12.31 m, min clearance 0.031 m", "believes it is there; is 5.83 m off, after 48.2 s,
/// 12.31 m": one line, the detail in brackets if there is one.
std::string verdict_words(const RunResult& result);

}  // namespace whisker::report
