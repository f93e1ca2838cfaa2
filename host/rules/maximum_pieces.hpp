/// Pieces of the maximum of several cut sets within one cell.
#pragma once

#include <vector>

#include "host/rules/aggregate.hpp"

namespace whisker::rules {

/// A set over one cell after the implication: factor * p, limited to `limit`.
struct Shaped {
  const CellSet* set;
  double factor;
  double limit;
  double low;  ///< least and greatest value
  double high;
  bool cut;  ///< p crosses the limit within the cell
};

/// False if it is zero all over the cell.
bool shape(const Cell& cell, const Activated& a, Shaped& out);

/// Where its limit is reached; only if cut.
double limit_root(const Shaped& s);

/// Buffers that one thread reuses.
struct Scratch {
  std::vector<Shaped> shaped;
  std::vector<double> cuts;
};

/// Calls visit(Piece) for each piece of the maximum.
template <class Visit>
void maximum_pieces(const Cell& cell, const std::vector<Activated>& activated, Scratch& scratch,
                    Visit&& visit);

}  // namespace whisker::rules

#include "host/rules/maximum_pieces_impl.hpp"
