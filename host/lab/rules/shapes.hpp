/// Membership functions by the names and the order of parameters of each format.
#pragma once

#include <vector>

#include "host/lab/rules/rule_base.hpp"
#include "host/lab/rules/source.hpp"

namespace whisker::rules {

/// 'trimf', [0 1 2] of a .fis file. `inputs`: the number of coefficients of a linear term; -1 among the terms
/// of an input, where crisp terms are refused.
void read_fis_shape(const Source& source, const Word& type, const std::vector<Word>& parameters, long inputs,
                    Term& out);

/// Triangle 0 1 2 of a .fll file, also of a .fcl file.
void read_fll_shape(const Source& source, const Word& type, const std::vector<Word>& parameters, long inputs,
                    Term& out);

}  // namespace whisker::rules
