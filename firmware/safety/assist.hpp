/// Bends and slows an operator's command by the response table.
#pragma once

#include "firmware/fuzzy/bilinear.hpp"
#include "firmware/math/trig.hpp"
#include "firmware/math/units.hpp"
#include "firmware/params.hpp"
#include "firmware/perception/local_grid.hpp"
#include "firmware/planning/manoeuvre.hpp"

namespace whisker::safety {

/// Between the command and the guard, which judges the result like any other request.
///
/// From the suspect cells of the local grid it takes how far the body can go, at most its diameter: straight
/// ahead, which gives D, and to each side, the farther of the ways at 30 and 60 degrees; their difference
/// gives R. SA then adds turning in proportion to the asked speed, so that the bend has the same curvature at
/// every speed. SD below 1 slows.
///
/// Only for forward requests: no beam looks behind the body. It has no memory.
class Assist {
 public:
  /// The table must outlive it. Initially the core's own.
  void use(const fuzzy::Bilinear::Table& table) noexcept { table_ = &table; }

  /// `fastest`: rim speed of the fastest turn on the spot. The result asks for no more forward speed than
  /// `asked`, for none if that asks for none, and turns no faster than the faster of `asked` and `fastest`.
  planning::VelocityRequest step(const planning::VelocityRequest& asked, Speed fastest, const Pose& pose,
                                 const perception::LocalGrid& grid, const Params& params) noexcept;
  /// It changed the last request.
  bool active() const noexcept { return active_; }

  /// The answers to the last request; zero if it was not for forward motion.
  const fuzzy::Response& response() const noexcept { return response_; }

  Assist() noexcept;

 private:
  const fuzzy::Bilinear::Table* table_;
  fuzzy::Response response_;
  bool active_ = false;
};

}  // namespace whisker::safety
