/// Reads rule bases of every format.
#pragma once

#include <string>
#include <string_view>

#include "host/lab/rules/rule_base.hpp"
#include "host/lab/rules/source.hpp"

namespace whisker::rules {

/// The format follows from the name: .fis, .fll, .fcl or .toml. Throws InputError with the place.
RuleBase read_rules(const std::string& file);
RuleBase parse_rules(std::string_view text, const std::string& name);

RuleBase read_fis(const Source& source);
RuleBase read_fll(const Source& source);
RuleBase read_fcl(const Source& source);
RuleBase read_toml(const Source& source);

/// What every format must satisfy: ranges, terms, rules that conclude something. Outputs of points alone
/// become singletons. Takes the warnings of the source.
void check(const Source& source, RuleBase& base);

}  // namespace whisker::rules
