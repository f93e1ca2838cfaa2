/// A straight drive of 3 m past a disc, at 0.3 m/s, with events.
#pragma once

#include <string>

#include "host/harness/run/runner.hpp"
#include "host/harness/scenario/load.hpp"

namespace whisker::test {

inline const std::string kBack = "x_m = 0\ny_m = -1\n";

inline Scenario scene(const std::string& events, const std::string& more = "") {
  return parse_scenario(
      "time_limit_s = 90\n[start]\nx_m = 0\ny_m = 0\n[goal]\nx_m = 3\ny_m = 0\n"
      "[[disc]]\ncenter = [1.5, 0.6]\nradius_m = 0.2\n" +
          more + events,
      "text");
}

inline std::string event(double t_s, const std::string& kind, const std::string& keys = "") {
  return "[[event]]\nt_s = " + std::to_string(t_s) + "\nkind = \"" + kind + "\"\n" + keys;
}

}  // namespace whisker::test
