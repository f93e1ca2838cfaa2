#include "host/harness/worlds/generate.hpp"

namespace whisker::worlds {

const char* name(Kind kind) {
  switch (kind) {
    case Kind::discs: return "discs";
    case Kind::poles: return "poles";
    case Kind::u_trap: return "u-trap";
    case Kind::spiral: return "spiral";
    case Kind::maze: return "maze";
    case Kind::rooms: return "rooms";
    case Kind::enclosed: return "enclosed";
    case Kind::enclosed_at_wall: return "enclosed-at-wall";
    case Kind::gap_at_wall: return "gap-at-wall";
    case Kind::contest_maze: return "contest-maze";
    case Kind::gap: return "gap";
    case Kind::disc_gap: return "disc-gap";
  }
  return "?";
}

std::optional<Kind> kind_named(std::string_view text) {
  for (const Kind kind : kAllKinds) {
    if (text == name(kind)) return kind;
  }
  return std::nullopt;
}

}  // namespace whisker::worlds
