#pragma once

#include <optional>
#include <queue>
#include <vector>

#include "host/lab/paths/free_arcs.hpp"
#include "host/lab/paths/inflated.hpp"
#include "host/lab/paths/shortest.hpp"

namespace whisker::paths {

/// A* over the tangents between rims. A node is a tangent at the place where it leaves its rim; from there
/// the path follows the tangent, or continues around the rim to the next tangent. The tangents of a rim are
/// computed when a path first arrives there, and checked for obstacles when a path would use them.
class Search {
 public:
  /// The inflated obstacles must outlive the search; both points must be free.
  Search(const Inflated& inflated, sim::Vec2 from, sim::Vec2 to);

  std::optional<Way> shortest();

 private:
  using Place = FreeArcs::Place;
  static constexpr int kStart = -1, kGoal = -2;

  /// A rim with the direction in which a path goes around it; kStart and kGoal for the two points.
  struct Stand {
    int rim = kStart;
    Side side = Side::left;
  };
  struct Node {
    Stand stand;
    Place place;  ///< on the stand's rim
    Tangent tangent;
    Stand to;
    Place to_place;
    double way_m = 0;  ///< shortest known path to the start of the tangent
    bool known = false, done = false;
    int before = -1;          ///< previous node of the path
    bool by_tangent = false;  ///< along that node's tangent, not only around the rim
    double swept_rad = 0;     ///< angle around the stand's rim at the end
  };
  struct Entry {
    double estimate_m;
    int node;
    bool operator<(const Entry& other) const { return estimate_m > other.estimate_m; }
  };
  struct Range {
    int first = -1, last = -1;
  };

  const sim::Disc& disc(Stand stand) const;
  const FreeArcs& arcs(Stand stand) const { return arcs_[static_cast<std::size_t>(stand.rim)]; }
  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  Range tangents_from(Stand stand);
  void add_tangent(Stand from, Stand to);
  void arrive(int node);
  void go_around(int node);
  void reach(int node, double way_m, int before, bool by_tangent, double swept_rad);
  Way way_to(int last);

  const Inflated& inflated_;
  sim::Disc start_, goal_;
  std::vector<FreeArcs> arcs_;
  std::vector<Node> nodes_;
  std::vector<Range> ranges_;  // of each stand's nodes, in the order of travel
  std::priority_queue<Entry> queue_;
};

}  // namespace whisker::paths
