/// A hill climb over response tables.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "firmware/fuzzy/bilinear.hpp"
#include "host/cli/campaign_options.hpp"
#include "host/harness/run/planners.hpp"
#include "host/lab/campaign/comparison.hpp"
#include "host/lab/campaign/worlds.hpp"
#include "host/lab/rules/mirrored_rules.hpp"

namespace whisker::cli {

/// Drives a mission in one way: side 0 is a, side 1 is b. Called on several threads at once; sets the jerk as
/// in Pair if it knows it. May throw campaign::Stopped once `stop` is true.
using DriveSide = std::function<campaign::Row(std::uint64_t mission, int side, double& jerk,
                                              const std::atomic<bool>& stop)>;

/// Drives missions 0..count-1 both ways on `jobs` threads (0: one per core). False: interrupted before the
/// end.
bool drive_pairs(std::uint64_t count, int jobs, const DriveSide& drive, std::vector<campaign::Pair>& pairs);

/// One mission with the kind's table, which bends the course.
campaign::Row drive_with_jerk(campaign::Mission mission, PlannerKind kind, double& jerk,
                              const std::atomic<bool>& stop);

/// Lines for people.
void print_comparison(std::FILE* out, const campaign::Comparison& c);
/// Without names of the two.
nlohmann::ordered_json comparison_json(const campaign::Comparison& c);
nlohmann::ordered_json estimate_json(const campaign::Estimate& e);

/// "0.987 [0.950, 1.026]"
std::string estimate_text(const campaign::Estimate& e, int digits);

struct SearchPlan {
  std::vector<Missions> classes;  ///< one for each kind of world; mission i of each has seed first_seed + i
  std::uint64_t first_seed = 1;
  std::uint64_t count = 40;  ///< worlds of a class in each generation, which has worlds of its own
  std::uint64_t generations = 20;
  std::uint64_t children = 8;
  std::uint64_t validation = 200;  ///< worlds of a class, none of them in a generation
  bool assist = false;             ///< the table helps a sloppy operator behind the guard
  int jobs = 0;

  std::uint64_t searched() const { return generations * count; }  ///< the validation's first mission
};

struct Candidate {
  rules::MirroredRules rules;
  std::shared_ptr<const fuzzy::Bilinear::Table> table;
  std::uint32_t digest = 0;
};

/// None if the look-up errs by more than a search admits. Throws InputError.
std::optional<Candidate> candidate(const rules::MirroredRules& rules);

struct Generation {
  std::uint64_t number = 0;  ///< from 1
  std::uint32_t digest = 0;  ///< of the child that came through all rounds
  campaign::Estimate time;   ///< it over its parent, in the worlds of the last round
  bool kept = false;         ///< it is the parent of the next generation
};

struct Validation {
  std::vector<campaign::Comparison> classes;
  campaign::Comparison all;
  campaign::Estimate time;  ///< as in Generation
  bool better = false;
};

class TableSearch {
 public:
  /// The plan must outlive the search. Equal plans and bases give equal results, whatever the jobs.
  TableSearch(const SearchPlan& plan, const Candidate& base)
      : plan_(plan), base_(base), best_(base), mutation_(plan.first_seed, plan.assist) {}

  /// Runs every generation, and calls `after` at the end of each. False: interrupted.
  bool run(const std::function<void(const Generation&)>& after);

  /// Base (a) and best (b) in worlds that no generation has driven. None: interrupted.
  std::optional<Validation> validate() const;

  const Candidate& base() const { return base_; }
  const Candidate& best() const { return best_; }
  const std::vector<Generation>& generations() const { return generations_; }

 private:
  std::vector<Candidate> field();
  bool race(const std::vector<Candidate>& field, std::vector<campaign::Standing>& standings,
            std::size_t& first);
  campaign::Row drive(std::size_t of_class, std::uint64_t mission, const Candidate& by, double& jerk,
                      const std::atomic<bool>& stop) const;
  double limit_s() const;

  const SearchPlan& plan_;
  const Candidate base_;
  Candidate best_;
  rules::Mutation mutation_;
  std::vector<Generation> generations_;
};

}  // namespace whisker::cli
