#include "host/lab/hunt/rows.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>

#include "firmware/math/work.hpp"
#include "host/harness/scenario/csv.hpp"
#include "host/harness/scenario/error.hpp"

namespace whisker::hunt {
namespace {

constexpr const char* kColumnNames =
    "seed,parent,family,world,driver,families_drawn,families_accepted,keys_drawn,keys_accepted,end,finding,"
    "time_s,path_m,gap_m,closeness,work,hash";
constexpr std::size_t kColumns = 17;
constexpr std::size_t kNearest = 5;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == ',') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

/// Texts of exceptions may contain anything.
std::string plain(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::uint64_t whole(const std::string& text, int base = 10) { return std::stoull(text, nullptr, base); }

Row row_of(const std::vector<std::string>& w) {
  Row row;
  row.seed = whole(w[0]);
  row.parent = w[1];
  row.family = w[2];
  row.world = w[3];
  row.driver = w[4];
  row.families = {whole(w[5]), whole(w[6])};
  row.keys = {whole(w[7]), whole(w[8])};
  row.end = w[9];
  row.finding = w[10];
  row.time_s = std::stod(w[11]);
  row.path_m = std::stod(w[12]);
  row.gap_m = std::stod(w[13]);
  row.closeness = std::stod(w[14]);
  row.work = std::stoi(w[15]);
  row.hash = whole(w[16], 16);
  return row;
}

void read(const std::string& file, std::vector<Row>& rows) {
  std::ifstream in(file);
  if (!in) throw InputError(file, 1, 1, "cannot be read");
  LineReader lines(in, file);
  while (lines.next()) {
    const std::vector<std::string> words = split(lines.line());
    // The last row of a killed hunt has no newline.
    if (lines.line() == kColumnNames || words.size() != kColumns || lines.cut()) continue;
    try {
      rows.push_back(row_of(words));
    } catch (const std::logic_error&) {
      lines.fail(1, "not a row of a hunt");
    }
  }
}

std::string percent(const Share& share) {
  if (share.drawn == 0) return "-";
  return fmt::format("{:.1f} %",
                     100.0 * static_cast<double>(share.accepted) / static_cast<double>(share.drawn));
}

void add(Share& sum, const Share& share) {
  sum.drawn += share.drawn;
  sum.accepted += share.accepted;
}

std::string findings_table(const std::vector<Row>& rows) {
  struct Found {
    std::uint64_t count = 0, least_seed = UINT64_MAX;
  };
  std::map<std::string, Found> all;
  for (const Row& row : rows) {
    if (row.finding.empty()) continue;
    Found& found =
        all[fmt::format("{:<24} {:<8} {:<10} {:<9}", row.finding, row.driver, row.family, row.world)];
    ++found.count;
    if (row.parent.empty()) found.least_seed = std::min(found.least_seed, row.seed);
  }
  if (all.empty()) return "nothing found\n";
  std::string text =
      fmt::format("{:<24} {:<8} {:<10} {:<9} cases  first seed\n", "finding", "driver", "family", "world");
  for (const auto& [what, found] : all) {
    const bool fresh = found.least_seed != UINT64_MAX;
    text += fmt::format("{} {:>5}  {}\n", what, found.count,
                        fresh ? std::to_string(found.least_seed) : "changed");
  }
  return text;
}

std::string shares_table(const std::vector<Row>& rows) {
  struct Shares {
    std::uint64_t cases = 0;
    Share families, keys;
  };
  std::map<std::string, Shares> all;
  for (const Row& row : rows) {
    if (!row.parent.empty() || row.family.empty()) continue;
    Shares& shares = all[row.family];
    ++shares.cases;
    add(shares.families, row.families);
    add(shares.keys, row.keys);
  }
  std::string text = "family     cases  accepted draws  of single keys\n";
  for (const auto& [family, shares] : all) {
    text += fmt::format("{:<10} {:>5}  {:>14}  {:>14}\n", family, shares.cases, percent(shares.families),
                        percent(shares.keys));
  }
  return text;
}

std::string nearest_table(std::vector<Row> rows) {
  rows.erase(std::remove_if(
                 rows.begin(), rows.end(),
                 [](const Row& r) { return !r.finding.empty() || !r.parent.empty() || r.driver == "part"; }),
             rows.end());
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return a.closeness != b.closeness ? a.closeness < b.closeness : a.seed < b.seed;
  });
  rows.resize(std::min(rows.size(), kNearest));
  std::string text = "nearest without a finding: gap less margin, in radii\n";
  for (const Row& row : rows) {
    text += fmt::format("{:>9.5f}  seed {}, {}, {}, {}\n", row.closeness, row.seed, row.driver, row.family,
                        row.world);
  }
  return text;
}

std::string dearest(const std::vector<Row>& rows) {
  const auto most =
      std::max_element(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.work < b.work; });
  if (most == rows.end() || most->work == 0) return "";
  return fmt::format("most work in a tick: {} of {} units, seed {}{}, {}, {}, {}\n", most->work, Work::kMost,
                     most->seed, most->parent.empty() ? "" : " changed", most->driver, most->family,
                     most->world);
}

}  // namespace

bool harms(const std::string& finding) {
  return finding == "contact" || finding == "judges_disagree" || finding.rfind("other_hash", 0) == 0 ||
         finding.rfind("crash", 0) == 0 || finding.rfind("part", 0) == 0;
}

std::string to_csv(const Row& r) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{:.3f},{:.4f},{:.7f},{:.6f},{},{:016x}\n", r.seed,
                     plain(r.parent), r.family, r.world, r.driver, r.families.drawn, r.families.accepted,
                     r.keys.drawn, r.keys.accepted, plain(r.end), plain(r.finding), r.time_s, r.path_m,
                     r.gap_m, r.closeness, r.work, r.hash);
}

Row parse_row(const std::string& line) { return row_of(split(line.substr(0, line.find('\n')))); }

std::vector<Row> read_rows(const std::vector<std::string>& files) {
  std::vector<Row> rows;
  for (const std::string& file : files) read(file, rows);
  return rows;
}

RowFile::RowFile(const std::string& path)
    : path_(path), fd_(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  struct stat status {};
  if (fd_ < 0 || ::fstat(fd_, &status) != 0) {
    throw std::system_error(errno, std::generic_category(), fmt::format("cannot write {}", path));
  }
  char last = '\n';
  if (status.st_size > 0 && ::pread(fd_, &last, 1, status.st_size - 1) != 1) last = 0;
  if (last != '\n') write("\n");
  if (status.st_size == 0) write(fmt::format("{}\n", kColumnNames));
}

RowFile::~RowFile() { ::close(fd_); }

void RowFile::add(const Row& row) { write(to_csv(row)); }

void RowFile::write(const std::string& line) {
  if (::write(fd_, line.data(), line.size()) == static_cast<ssize_t>(line.size())) return;
  throw std::system_error(errno, std::generic_category(), fmt::format("cannot write {}", path_));
}

std::string summary(const std::vector<Row>& rows) {
  return fmt::format("{} cases\n\n{}\n{}\n{}{}", rows.size(), findings_table(rows), shares_table(rows),
                     nearest_table(rows), dearest(rows));
}

}  // namespace whisker::hunt
