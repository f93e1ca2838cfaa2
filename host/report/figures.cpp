#include "host/report/figures.hpp"

namespace whisker::report {

std::vector<std::pair<std::string, std::string>> thesis_figures(const FuzzyPicture& picture) {
  check(picture);
  return {
      {"figure2.svg", membership_svg(picture.d, "Figure 2: membership functions of " + picture.d.symbol)},
      {"figure3.svg", membership_svg(picture.r, "Figure 3: membership functions of " + picture.r.symbol)},
      {"figure4.svg", membership_svg(picture.sa, "Figure 4: membership functions of " + picture.sa.symbol)},
      {"figure5.svg", membership_svg(picture.sd, "Figure 5: membership functions of " + picture.sd.symbol)},
      {"figure6.svg", rules_svg(picture, "Figure 6: the fuzzy control rules")},
      {"figure7.svg", surface_svg(picture, "Figure 7: the response surface")},
  };
}

}  // namespace whisker::report
