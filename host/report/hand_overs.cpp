#include "host/report/hand_overs.hpp"

namespace whisker::report {

std::vector<HandOver> hand_overs(const std::vector<TickRecord>& records) {
  std::vector<HandOver> all;
  bool begun = false;
  bool led = false;
  for (const TickRecord& r : records) {
    const bool leads = guides(r.guide);
    if (begun && leads != led) all.push_back({&r, led});
    begun = begun || leads;
    led = leads;
  }
  return all;
}

}  // namespace whisker::report
