/// Figures 2 to 7 of the thesis, drawn from the controller's data. Figures 8 to 10 are runs: run_svg.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/lab/report/fuzzy_picture.hpp"

namespace whisker::report {

/// The memberships of one variable: triangles between neighbouring centres, shoulders at both ends.
/// Throws as check() does.
std::string membership_svg(const Variable& variable, const std::string& title);

/// The rule base as coloured squares: one 5 x 5 picture for SA, one for SD. Throws as check() does.
std::string rules_svg(const FuzzyPicture& picture, const std::string& title);

/// The response as two surfaces seen from above the corner where D is least and R greatest. Throws as check()
/// does.
std::string surface_svg(const FuzzyPicture& picture, const std::string& title);

/// File names ("figure2.svg" to "figure7.svg") and their content, in order. Throws as check() does.
std::vector<std::pair<std::string, std::string>> thesis_figures(const FuzzyPicture& picture);

}  // namespace whisker::report
