#include "host/cli/provenance.hpp"

#include <commit.hpp>

namespace whisker::cli {

std::string version() { return WHISKER_VERSION " (" WHISKER_COMMIT ")"; }

}  // namespace whisker::cli
