#include "host/harness/worlds/generate.hpp"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>
#include <utility>

#include "host/harness/worlds/kept.hpp"

namespace whisker::worlds {
namespace {

constexpr int kMostDiscs = 200;

bool has_gap_of_width(Kind kind) { return kind == Kind::gap || kind == Kind::disc_gap; }
bool has_discs(Kind kind) {
  return kind != Kind::u_trap && kind != Kind::spiral && kind != Kind::maze && kind != Kind::contest_maze &&
         !has_gap_of_width(kind);
}
/// The other kinds always or never have it.
bool may_have_box(Kind kind) { return kind == Kind::discs || kind == Kind::poles || kind == Kind::enclosed; }

void check(Kind kind, const Options& o) {
  if (o.seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    throw std::invalid_argument("the seed must be less than 2^63");
  }
  if (o.discs && !has_discs(kind)) throw std::invalid_argument(fmt::format("{} has no discs", name(kind)));
  if (o.discs && (*o.discs < 0 || *o.discs > kMostDiscs)) {
    throw std::invalid_argument(fmt::format("discs must be from 0 to {}, but is {}", kMostDiscs, *o.discs));
  }
  if (o.wheel_scale_sigma) {
    if (!o.noise) throw std::invalid_argument("a scale error of the wheels needs noise");
    if (!(*o.wheel_scale_sigma >= 0 && *o.wheel_scale_sigma <= 1)) {
      throw std::invalid_argument("the scale error of the wheels must be from 0 to 1");
    }
  }
  if (o.gap_m) {
    if (!has_gap_of_width(kind)) throw std::invalid_argument(fmt::format("{} takes no width", name(kind)));
    if (!(*o.gap_m >= kGapMin && *o.gap_m <= kGapMax)) {
      throw std::invalid_argument(fmt::format("the width must be from {} to {} m", kGapMin, kGapMax));
    }
  }
  if (o.box && !may_have_box(kind)) throw std::invalid_argument(fmt::format("{} takes no box", name(kind)));
}

}  // namespace

Scenario generate(Kind kind, const Options& options) {
  check(kind, options);
  std::optional<Scenario> kept = first_kept(kind, options);
  if (!kept) {
    throw std::runtime_error(fmt::format("{} draws gave no {} world with {}", kMostDraws, name(kind),
                                         has_no_way(kind) ? "its goal shut in" : "a path to its goal"));
  }
  kept->name =
      fmt::format("{}{}{}{}{}, seed {}", name(kind), options.discs ? fmt::format(" {}", *options.discs) : "",
                  options.gap_m ? fmt::format(" {} m", *options.gap_m) : "", options.box ? " in a box" : "",
                  options.noise ? " with noise" : "", options.seed);
  return *std::move(kept);
}

}  // namespace whisker::worlds
