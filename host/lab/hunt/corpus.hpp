/// The cases that came nearest to a violation, and those with rare states: one for each niche.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "host/lab/hunt/dice.hpp"
#include "host/lab/hunt/trial.hpp"

namespace whisker::hunt {

class Corpus {
 public:
  /// With what the folder holds already; empty: keeps nothing on disk. The folder must exist.
  explicit Corpus(std::string folder);

  /// The niche for which this outcome is the nearest so far, or which has a state that none had; empty: none.
  std::string niche(const std::string& kind, const Outcome& outcome) const;
  /// Keeps the case as the best of this niche.
  void keep(const std::string& niche, const Case& c, const Outcome& outcome);
  bool empty() const { return kept_.empty(); }
  std::size_t size() const { return kept_.size(); }

  struct Pick {
    const std::string& niche;
    const Case& c;
  };
  /// Rather one that came near. The corpus must not be empty.
  Pick pick(Dice& dice) const;

 private:
  struct Kept {
    Case c;
    double closeness;
  };
  std::string folder_;
  std::map<std::string, Kept> kept_;
  std::set<std::string> states_;
};

}  // namespace whisker::hunt
