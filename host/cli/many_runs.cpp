#include "host/cli/many_runs.hpp"

#include <chrono>
#include <string>
#include <thread>

#include <fmt/core.h>

#include "host/campaign/ordered.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/output.hpp"

namespace whisker::cli {
namespace {

/// "[#####.....]  512 of 1024, 48.1 a second, 0:11 to go"
std::string progress(std::uint64_t done, std::uint64_t all, double elapsed_s) {
  constexpr std::uint64_t kWidth = 30;
  const auto filled = static_cast<std::size_t>(done * kWidth / all);
  std::string text =
      fmt::format("[{}{}] {} of {}", std::string(filled, '#'), std::string(kWidth - filled, '.'), done, all);
  if (done == 0 || elapsed_s <= 0) return text;
  const double rate = static_cast<double>(done) / elapsed_s;
  const auto left_s = static_cast<std::uint64_t>(static_cast<double>(all - done) / rate + 0.5);
  return text + fmt::format(", {:.1f} a second, {}:{:02} to go", rate, left_s / 60, left_s % 60);
}

int threads(int jobs) {
  if (jobs > 0) return jobs;
  const unsigned cores = std::thread::hardware_concurrency();
  return cores > 0 ? static_cast<int>(cores) : 1;
}

}  // namespace

bool make_many(std::uint64_t count, int jobs,
               const std::function<campaign::Row(std::uint64_t, const std::atomic<bool>&)>& make,
               const std::function<void(const campaign::Row&)>& take) {
  const Interrupt interrupt;
  ProgressLine line;
  const auto began = std::chrono::steady_clock::now();
  campaign::Work work;
  work.count = count;
  work.jobs = threads(jobs);
  work.make = make;
  work.take = take;
  work.wait = [&](std::uint64_t done) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
    line.show(progress(done, work.count, elapsed.count()));
  };
  work.stop = [&] { return interrupt.noted(); };
  return campaign::do_in_order(work) == work.count;
}

bool drive_many(const Missions& missions, int jobs,
                const std::function<campaign::Row(const Scenario&, const std::atomic<bool>& stop)>& drive,
                const std::function<void(const campaign::Row&)>& take) {
  const auto make = [&](std::uint64_t i, const std::atomic<bool>& stop) {
    const campaign::Mission m = mission(missions, missions.first + i);
    campaign::Row row = drive(m.scenario, stop);
    row.robot = missions.robot;
    row.world = m.world;
    return row;
  };
  return make_many(missions.last - missions.first, jobs, make, take);
}

}  // namespace whisker::cli
