/// Data for the pictures of the fuzzy controller, independent of the engine.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace whisker::report {

struct Term {
  std::string name;
  double centre = 0;
};

struct Variable {
  std::string symbol;   ///< "D"
  std::string meaning;  ///< "distance to the obstacles ahead"
  double min = 0;
  double max = 0;           ///< > min
  std::vector<Term> terms;  ///< at least two, by ascending centre
};

struct Rule {
  std::string term;  ///< name of the output term; may be empty for an edited value
  double value = 0;
};

struct FuzzyPicture {
  Variable d, r, sa, sd;
  std::vector<std::vector<Rule>> turn;  ///< [term of D][term of R]: SA
  std::vector<std::vector<Rule>> step;  ///< the same for SD
  std::function<double(double d, double r)> sa_at;
  std::function<double(double d, double r)> sd_at;
  std::vector<double> d_nodes, r_nodes;  ///< borders of the engine's cells, ascending; may be empty
  std::string source;                    ///< name of the engine, e.g. "bilinear table, 41 x 65"; may be empty
};

/// Throws std::invalid_argument with one line that names missing or inconsistent data.
void check(const FuzzyPicture& picture);
void check(const Variable& variable);

}  // namespace whisker::report
