/// A rule base as the response table of the core.
#pragma once

#include <string>
#include <vector>

#include "firmware/fuzzy/bilinear.hpp"
#include "host/lab/rules/rule_base.hpp"

namespace whisker::rules {

/// The names in the rule base of the core's variables (firmware/fuzzy/variables.hpp).
struct ResponseNames {
  std::string distance = "D";
  std::string bias = "R";
  std::string turn = "SA";
  std::string step = "SD";
};

/// Changes the names by "CORE=NAME", for example "D=front"; CORE is D, R, SA or SD. Throws
/// std::invalid_argument with one line.
ResponseNames response_names(const std::vector<std::string>& changes);

struct Response {
  fuzzy::Bilinear::Table table;
  /// Greatest difference of the look-up from the exact answer, at any D and R that the core can ask for.
  double turn_error = 0;
  double step_error = 0;
  bool symmetric = false;  ///< the table of a mirrored world is the mirrored table, to the last bit
};

/// Samples the exact answers at the core's nodes. Other inputs than these two must not exist, the ranges of
/// the two must cover the core's, and answers must lie in [-2, 2). Throws InputError if not.
Response response(const RuleBase& base, const ResponseNames& names);

}  // namespace whisker::rules
