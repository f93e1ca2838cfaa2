#include "host/lab/hunt/hunt.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "host/lab/hunt/corpus.hpp"
#include "host/lab/hunt/crew.hpp"
#include "host/lab/hunt/draw.hpp"
#include "host/lab/hunt/shrink.hpp"
#include "host/lab/hunt/trial.hpp"

namespace whisker::hunt {
namespace {

constexpr std::uint64_t kShrunkOfAKind = 3;
constexpr Effort kEffortForHarm{400, 60};
constexpr Effort kEffort{60, 15};  // for robots that stop or err
/// Between what a job says: the drawn row, the judged row, and what the corpus takes.
constexpr char kBreak = '\x1e';

Row drawn_row(std::uint64_t seed, const Drawn& drawn) {
  Row row;
  row.seed = seed;
  row.family = drawn.c.part.empty() ? name(drawn.robot.family) : drawn.c.part;
  row.world = drawn.c.part.empty() ? name(drawn.world) : "";
  row.driver = driver(drawn.c);
  row.families = drawn.robot.families;
  row.keys = drawn.robot.keys;
  return row;
}

void judge(Row& row, const Outcome& outcome) {
  row.end = outcome.end;
  row.finding = outcome.finding;
  row.time_s = outcome.time_s;
  row.path_m = outcome.path_m;
  row.gap_m = outcome.gap_m;
  row.closeness = outcome.closeness;
  row.work = outcome.work;
  row.hash = outcome.hash;
}

std::string kind_of(const Row& row) { return fmt::format("{}-{}-{}", row.driver, row.family, row.world); }

struct Parts {
  std::vector<std::string> all;
  explicit Parts(const std::string& text) {
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t end = std::min(text.find(kBreak, from), text.size());
      all.push_back(text.substr(from, end - from));
      from = end + 1;
    }
  }
  const std::string& at(std::size_t i) const {
    static const std::string none;
    return i < all.size() ? all[i] : none;
  }
};

class Hunt {
 public:
  explicit Hunt(const Options& o)
      : options_(o), corpus_(folder("corpus")), dice_(~o.seed), next_(o.seed + o.shard) {
    folder("findings");
    if (o.out.empty()) return;
    const std::string path = o.out + "/rows.csv";
    if (std::filesystem::exists(path)) {
      for (const Row& row : read_rows({path})) {
        if (row.parent.empty()) done_.insert(row.seed);
      }
    }
    rows_ = std::make_unique<RowFile>(path);
  }

  bool run() {
    while (true) {
      while (crew_.busy() < static_cast<std::size_t>(options_.jobs) && start_one()) {
      }
      if (crew_.busy() == 0) break;
      for (const Ended& ended : crew_.wait()) take(ended);
      progress_.corpus = corpus_.size();
      progress_.elapsed_s = elapsed_s();
      progress_.processor_s = processor_s();
      if (options_.show) options_.show(progress_, nullptr);
    }
    return progress_.findings == 0;
  }

 private:
  struct Piece {
    std::uint64_t seed = 0;
    std::string parent;
    Case c;  // of a changed case, before the change
    std::string family, world;
    bool shrinks = false;
    Row row;  // that is shrunk
    std::string path;
  };

  std::string folder(const std::string& inner) const {
    if (options_.out.empty()) return "";
    std::filesystem::create_directories(options_.out + "/" + inner);
    return options_.out + "/" + inner;
  }
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }
  /// Of the jobs that ended.
  static double processor_s() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  }
  bool over() const {
    return (options_.stop && options_.stop()) || (options_.time_s > 0 && elapsed_s() >= options_.time_s);
  }

  bool start_one() {
    if (!shrinks_.empty()) return start_shrink();
    if (over()) return false;
    const bool changes = options_.time_s > 0 && !corpus_.empty() && dice_.chance(0.5);
    return changes ? start_changed() : start_fresh();
  }

  bool start_fresh() {
    while (done_.count(next_) != 0) next_ += options_.shards;
    if (options_.count != 0 && next_ - options_.seed >= options_.count) return false;
    Piece piece;
    piece.seed = next_;
    next_ += options_.shards;
    const Job job = [this, seed = piece.seed](const Say& say) {
      Drawn drawn = draw_fresh(seed);
      Row row = drawn_row(seed, drawn);
      say(to_csv(row));
      drive(drawn.c, row, say);
    };
    start(std::move(piece), job);
    return true;
  }

  bool start_changed() {
    const Corpus::Pick pick = corpus_.pick(dice_);
    Piece piece;
    piece.seed = dice_.bits();
    piece.parent = pick.niche;
    piece.c = pick.c;
    const Job job = [this, before = pick.c, seed = piece.seed, parent = piece.parent](const Say& say) {
      Case c = changed(before, seed);
      Row row;
      row.seed = seed;
      row.parent = parent;
      row.family = "changed";
      row.world = "changed";
      row.driver = driver(c);
      say(to_csv(row));
      drive(c, row, say);
    };
    start(std::move(piece), job);
    return true;
  }

  /// In the job's process. The corpus is that of the time when the job began.
  void drive(Case& c, Row& row, const Say& say) const {
    const Outcome outcome = attempt(c);
    judge(row, outcome);
    say(kBreak + to_csv(row));
    const std::string niche =
        outcome.finding.empty() ? corpus_.niche(row.parent.empty() ? kind_of(row) : row.parent, outcome) : "";
    if (niche.empty() && outcome.finding.empty()) return;
    const Texts both = texts(c, "case");
    say(fmt::format("{0}{1}{0}{2}{0}{3}{0}", kBreak, niche, both.toml, both.csv));
    for (const std::string& state : outcome.states) say(state + "\n");
  }

  void start(Piece piece, const Job& job) {
    const std::uint64_t id = ++ids_;
    crew_.start(id, job);
    pieces_.emplace(id, std::move(piece));
  }

  void take(const Ended& ended) {
    const auto at = pieces_.find(ended.id);
    const Piece piece = std::move(at->second);
    pieces_.erase(at);
    if (piece.shrinks) return took_shrunk(piece, ended);
    const Parts parts(ended.text);
    Row row = judged_row(piece, parts);
    if (!ended.death.empty()) {
      row.end = row.finding = fmt::format("crash {}", ended.death);
    } else if (!parts.at(2).empty()) {
      keep(parts, row);
    }
    ++progress_.cases;
    if (rows_) rows_->add(row);
    if (!row.finding.empty()) note(piece, parts, row);
    if (options_.show) options_.show(progress_, &row);
  }

  static Row judged_row(const Piece& piece, const Parts& parts) {
    Row row;
    row.seed = piece.seed;
    row.parent = piece.parent;
    for (const std::size_t part : {std::size_t{0}, std::size_t{1}}) {
      if (!parts.at(part).empty()) row = parse_row(parts.at(part));
    }
    return row;
  }

  void keep(const Parts& parts, const Row& row) {
    Outcome outcome;
    outcome.closeness = row.closeness;
    outcome.work = row.work;
    const std::string& states = parts.at(5);
    for (std::size_t from = 0; from < states.size();) {
      const std::size_t end = states.find('\n', from);
      outcome.states.insert(states.substr(from, end - from));
      from = end + 1;
    }
    corpus_.keep(parts.at(2), parse_case({parts.at(3), parts.at(4)}, "case"), outcome);
  }

  /// Only a few of each kind are shrunk.
  void note(const Piece& piece, const Parts& parts, const Row& row) {
    ++progress_.findings;
    const std::string kind = fmt::format("{} {} {}", row.finding, row.driver, row.family);
    if (++kinds_[kind] > kShrunkOfAKind) return;
    Piece shrink;
    shrink.row = row;
    shrink.shrinks = true;
    if (!parts.at(3).empty()) {
      shrink.c = parse_case({parts.at(3), parts.at(4)}, "case");
    } else {
      shrink.c = piece.parent.empty() ? draw_fresh(piece.seed).c : changed(piece.c, piece.seed);
    }
    shrinks_.push_back(std::move(shrink));
  }

  bool start_shrink() {
    Piece piece = std::move(shrinks_.back());
    shrinks_.pop_back();
    const std::string finding = piece.row.finding;
    if (!options_.out.empty()) piece.path = fmt::format("{}/findings/{}", options_.out, file_of(piece.row));
    const Job job = [whole = piece.c, path = piece.path, finding](const Say&) {
      const Case c = shrunk(
          whole, [&](Case& other) { return finding_of(other) == finding; },
          harms(finding) ? kEffortForHarm : kEffort);
      if (!path.empty()) save(c, path);
    };
    start(std::move(piece), job);
    return true;
  }

  static std::string file_of(const Row& row) {
    std::string file =
        fmt::format("{}-{}-{}{}", row.finding, row.driver, row.parent.empty() ? "" : "changed-", row.seed);
    for (char& c : file) {
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '-';
    }
    return file;
  }

  void took_shrunk(const Piece& piece, const Ended& ended) {
    if (options_.found) options_.found(piece.row, progress_, ended.death.empty() ? piece.path : "");
  }

  const Options& options_;
  Corpus corpus_;
  Dice dice_;
  std::uint64_t next_;
  std::uint64_t ids_ = 0;
  std::set<std::uint64_t> done_;
  std::unique_ptr<RowFile> rows_;
  Crew crew_;
  std::map<std::uint64_t, Piece> pieces_;
  std::vector<Piece> shrinks_;
  std::map<std::string, std::uint64_t> kinds_;
  Progress progress_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace

bool hunt(const Options& options) { return Hunt(options).run(); }

}  // namespace whisker::hunt
