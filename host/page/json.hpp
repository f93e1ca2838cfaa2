/// The parts of a page's data.
#pragma once

#include <nlohmann/json.hpp>

#include "host/page/page.hpp"

namespace whisker::page {

using Json = nlohmann::ordered_json;

/// What all runs of a page have in common: names of states and reasons, colours, the response table.
Json shared_data(const Controller& controller);

Json campaign_data(const std::vector<campaign::Row>& rows);

}  // namespace whisker::page
