#include "host/lab/report/fuzzy_picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace whisker::report {
namespace {

void check_rules(const std::vector<std::vector<Rule>>& rules, const FuzzyPicture& picture,
                 const char* output) {
  bool fits = rules.size() == picture.d.terms.size();
  for (const auto& row : rules) fits = fits && row.size() == picture.r.terms.size();
  if (!fits)
    throw std::invalid_argument(fmt::format("the rules of {} are not {} x {}", output, picture.d.terms.size(),
                                            picture.r.terms.size()));
}

}  // namespace

void check(const Variable& v) {
  if (!(v.min < v.max) || !std::isfinite(v.max - v.min))
    throw std::invalid_argument(fmt::format("{}: the range is empty", v.symbol));
  if (v.terms.size() < 2) throw std::invalid_argument(fmt::format("{}: fewer than two terms", v.symbol));
  for (std::size_t i = 0; i < v.terms.size(); ++i) {
    const double centre = v.terms[i].centre;
    const bool rises = i == 0 || centre > v.terms[i - 1].centre;
    if (!(centre >= v.min && centre <= v.max && rises))
      throw std::invalid_argument(
          fmt::format("{}: the centre of {} is out of order", v.symbol, v.terms[i].name));
  }
}

void check(const FuzzyPicture& picture) {
  for (const Variable* v : {&picture.d, &picture.r, &picture.sa, &picture.sd}) check(*v);
  check_rules(picture.turn, picture, "SA");
  check_rules(picture.step, picture, "SD");
  if (!picture.sa_at || !picture.sd_at) throw std::invalid_argument("a response function is missing");
}

}  // namespace whisker::report
