#include "host/lab/campaign/ordered.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace whisker::campaign {
namespace {

using Result = std::variant<Row, std::exception_ptr>;

class Pool {
 public:
  explicit Pool(const Work& work) : work_(work), running_(work.jobs) {
    for (int i = 0; i < work.jobs; ++i) threads_.emplace_back([this] { make_some(); });
  }
  ~Pool() {
    stop();
    for (std::thread& thread : threads_) thread.join();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void stop() { ended_ = stop_ = true; }

  enum class Wait { ready, not_yet, never };
  /// Waits a short time for the result of this piece.
  Wait wait_for(std::uint64_t piece) {
    std::unique_lock lock(mutex_);
    const auto ready = [&] { return results_.count(piece) != 0; };
    changed_.wait_for(lock, std::chrono::milliseconds(100), [&] { return ready() || running_ == 0; });
    if (ready()) return Wait::ready;
    return running_ == 0 ? Wait::never : Wait::not_yet;
  }
  /// Precondition: the result is ready.
  Result take(std::uint64_t piece) {
    const std::scoped_lock lock(mutex_);
    Result result = std::move(results_.at(piece));
    results_.erase(piece);
    return result;
  }

 private:
  void make_some() {
    while (!ended_) {
      const std::uint64_t piece = next_++;
      if (piece >= work_.count) break;
      make(piece);
    }
    const std::scoped_lock lock(mutex_);
    --running_;
    changed_.notify_one();
  }

  void make(std::uint64_t piece) {
    try {
      put(piece, work_.make(piece, stop_));
    } catch (const Stopped&) {
      ended_ = true;
    } catch (...) {
      ended_ = true;
      put(piece, std::current_exception());
    }
  }

  void put(std::uint64_t piece, Result result) {
    const std::scoped_lock lock(mutex_);
    results_.emplace(piece, std::move(result));
    changed_.notify_one();
  }

  const Work& work_;
  std::atomic<std::uint64_t> next_{0};
  std::atomic<bool> ended_{false};  // no further piece is started
  std::atomic<bool> stop_{false};   // running pieces shall stop
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::uint64_t, Result> results_;
  int running_;
  std::vector<std::thread> threads_;
};

}  // namespace

std::uint64_t do_in_order(const Work& work) {
  Pool pool(work);
  std::uint64_t taken = 0;
  while (taken < work.count) {
    if (work.stop()) pool.stop();
    work.wait(taken);
    const Pool::Wait wait = pool.wait_for(taken);
    if (wait == Pool::Wait::never) break;
    if (wait == Pool::Wait::not_yet) continue;
    const Result result = pool.take(taken);
    if (const auto* error = std::get_if<std::exception_ptr>(&result)) std::rethrow_exception(*error);
    work.take(std::get<Row>(result));
    ++taken;
  }
  return taken;
}

}  // namespace whisker::campaign
