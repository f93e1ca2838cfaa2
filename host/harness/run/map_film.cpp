#include "host/harness/run/map_film.hpp"

#include <utility>

namespace whisker {
namespace {

constexpr std::int32_t kWordBits = 32;

std::size_t wrapped(std::int32_t cell, std::int32_t count) {
  return static_cast<std::size_t>((cell % count + count) % count);
}

std::vector<std::uint32_t> words_of(const MapPicture& picture) {
  const auto words = static_cast<std::size_t>(picture.columns / kWordBits);
  const std::size_t plane = words * static_cast<std::size_t>(picture.rows);
  std::vector<std::uint32_t> all(MapFilm::kPlanes * plane);
  const auto set = [&](std::size_t which, std::int32_t x, std::int32_t y) {
    const std::size_t column = wrapped(picture.corner.x + x, picture.columns);
    const std::size_t row = wrapped(picture.corner.y + y, picture.rows);
    all[which * plane + row * words + column / kWordBits] |= std::uint32_t{1} << (column % kWordBits);
  };
  for (std::int32_t y = 0; y < picture.rows; ++y) {
    for (std::int32_t x = 0; x < picture.columns; ++x) {
      const auto state = static_cast<unsigned>(picture.at(x, y));
      if ((state & 2U) != 0) set(0, x, y);
      if ((state & 1U) != 0) set(1, x, y);
    }
  }
  for (const planning::Cell p : picture.way) set(2, p.x, p.y);
  return all;
}

}  // namespace

void MapFrames::append(const MapFrames& more, std::size_t from_tick) {
  const std::ptrdiff_t first = more.pictures.before(from_tick);
  pictures.append(more.pictures, from_tick);
  x.insert(x.end(), more.x.begin() + first, more.x.end());
  y.insert(y.end(), more.y.begin() + first, more.y.end());
}

void MapFilm::add(std::size_t tick, const MapPicture& picture, MapFrames& frames) {
  std::vector<std::uint32_t> now = words_of(picture);
  last_.resize(now.size());
  frames.pictures.add(tick, now.data(), last_.data(), now.size());
  frames.x.push_back(picture.corner.x);
  frames.y.push_back(picture.corner.y);
  last_ = std::move(now);
}

}  // namespace whisker
