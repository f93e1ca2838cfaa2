/// A drive of the guard as one self-contained file for a browser.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/lab/guard/drive.hpp"
#include "host/lab/page/page.hpp"

namespace whisker::page {

/// How the drive was set up.
struct GuardSetting {
  const Scenario& scenario;
  std::string hand;  ///< who commands, in words
  bool guarded = true;
  double vouched_m = 0;
};

/// Records the data of a drive while it runs.
class GuardRecording {
 public:
  explicit GuardRecording(GuardSetting setting)
      : setting_(std::move(setting)),
        log_({setting_.scenario, std::nullopt, setting_.scenario.seed, setting_.guarded}) {}
  /// For guard::Options::watch.
  void add(const guard::Moment& moment);
  StoredRun stored(const guard::Result& result) const;

 private:
  /// What one tick asked for and got.
  struct Grant {
    Velocity asked;
    Q14 forward, turning;
    GuardReason reason;
  };
  template <class F>
  std::vector<std::int64_t> column(F&& value_of) const {
    std::vector<std::int64_t> values;
    values.reserve(grants_.size());
    for (const Grant& grant : grants_) values.push_back(static_cast<std::int64_t>(value_of(grant)));
    return values;
  }

  GuardSetting setting_;
  RunLog log_;
  std::vector<Grant> grants_;
};

std::string guard_page(const StoredRun& drive);

}  // namespace whisker::page
