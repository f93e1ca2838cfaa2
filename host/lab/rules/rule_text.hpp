/// Rules as text: "if a is x and b is not y then c is z with 0.5", of .fll and .fcl files.
#pragma once

#include <string>

#include "host/lab/rules/rule_base.hpp"
#include "host/lab/rules/source.hpp"

namespace whisker::rules {

/// "if service is poor or food is not rancid then tip is cheap with 0.5".
std::string words(const RuleBase& base, const Rule& rule);

enum class Dialect {
  fll,  ///< keywords in lower case; hedges before the term
  fcl,  ///< keywords in any case; NOT before parts of a condition; conclusions also joined by commas
};

/// Appends antecedent, conclusions and weight to the rule. The variables of the base must be complete.
void read_rule_text(const Source& source, Word text, Dialect dialect, const RuleBase& base, Rule& out);

}  // namespace whisker::rules
