#pragma once

#include <string>
#include <vector>

#include "host/campaign/row.hpp"
#include "host/cli/campaign_options.hpp"

namespace whisker::cli {

/// Runs missions again to record them, the worst first and as many as a page holds, and writes a page of all.
/// rows[i] is mission first + i.
void write_campaign_page(const std::string& path, const Missions& missions,
                         const std::vector<campaign::Row>& rows);

}  // namespace whisker::cli
