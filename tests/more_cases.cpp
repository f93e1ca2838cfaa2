// Linked into programs whose properties need more than rapidcheck's default of 100 cases. The caller's
// RC_PARAMS has precedence; a number of cases is added only if it names none.
#include <cstdlib>
#include <string>

namespace {

bool ask_for_more_cases() {
  const char* const given = std::getenv("RC_PARAMS");
  std::string params = given == nullptr ? "" : given;
  if (params.find("max_success") != std::string::npos || params.find("reproduce") != std::string::npos)
    return false;
  if (!params.empty()) params += ' ';
  return setenv("RC_PARAMS", (params + "max_success=500").c_str(), 1) == 0;
}

const bool kMoreCases = ask_for_more_cases();

}  // namespace
