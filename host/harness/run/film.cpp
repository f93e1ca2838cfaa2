#include "host/harness/run/film.hpp"

#include <algorithm>
#include <numeric>

#include "host/harness/run/clear_cells.hpp"

namespace whisker {
namespace {

std::size_t wrapped(std::int64_t cell) { return static_cast<std::uint64_t>(cell) % Film::kSide; }

}  // namespace

void Frames::add(std::size_t tick, const std::uint32_t* now, const std::uint32_t* last, std::size_t count) {
  const std::size_t had = words.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (now[i] == last[i]) continue;
    words.push_back(static_cast<std::int64_t>(i));
    bits.push_back(now[i] ^ last[i]);
  }
  ticks.push_back(static_cast<std::int64_t>(tick));
  changes.push_back(static_cast<std::int64_t>(words.size() - had));
}

std::ptrdiff_t Frames::before(std::size_t tick) const {
  return std::lower_bound(ticks.begin(), ticks.end(), static_cast<std::int64_t>(tick)) - ticks.begin();
}

void Frames::append(const Frames& more, std::size_t from_tick) {
  const std::ptrdiff_t first = more.before(from_tick);
  const std::ptrdiff_t change =
      std::accumulate(more.changes.begin(), more.changes.begin() + first, std::ptrdiff_t{0});
  const auto add = [](auto& to, const auto& list, std::ptrdiff_t skipped) {
    to.insert(to.end(), list.begin() + skipped, list.end());
  };
  add(ticks, more.ticks, first);
  add(changes, more.changes, first);
  add(words, more.words, change);
  add(bits, more.bits, change);
}

Film::Film(const Params& params) : params_(params) {}

Film::Picture Film::picture(Vec body, const perception::LocalGrid& local_grid) const {
  Picture now{};
  for_each_clear_cell(local_grid, params_, body, [&now](std::int64_t x, std::int64_t y) {
    const std::size_t column = wrapped(x);
    now[2 * wrapped(y) + column / 32] |= std::uint32_t{1} << (column % 32);
  });
  return now;
}

void Film::add(std::size_t tick, Vec body, const perception::LocalGrid& local_grid, Frames& frames) {
  const Picture now = picture(body, local_grid);
  frames.add(tick, now.data(), last_.data(), now.size());
  last_ = now;
}

}  // namespace whisker
