/// Rules in words, whatever the format of their file.
#pragma once

#include <string>

#include "host/rules/rule_base.hpp"

namespace whisker::rules {

/// "if service is poor or food is not rancid then tip is cheap with 0.5".
std::string words(const RuleBase& base, const Rule& rule);

}  // namespace whisker::rules
