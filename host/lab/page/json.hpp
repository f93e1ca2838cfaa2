/// The parts of a page's data.
#pragma once

#include <nlohmann/json.hpp>

#include "host/lab/page/columns.hpp"
#include "host/lab/page/page.hpp"
#include "host/lab/report/encounters.hpp"

namespace whisker::page {

using Json = nlohmann::ordered_json;

/// Data shared by all runs of a page: names of states, reasons, faults and guides.
Json names_data();
/// The same, and the response table.
Json shared_data(const Controller& controller);

/// A run before its first tick: world, robot and noise.
Json setting_data(const RunSetting& setting);

Json edges_data(const std::vector<report::EncounterFinder::Found>& found);

/// Some ticks as columns.
struct Packed {
  Json list;         ///< of the columns
  std::string data;  ///< base64 of the deflated columns
};
Packed packed(const Ticks& ticks, Detail detail = Detail::full);
Packed packed(const Columns& columns);
void add_ticks(Columns& columns, const Ticks& ticks, Detail detail);

/// Plain ASCII on one line for any content.
std::string text_of(const Json& json);

Json campaign_data(const std::vector<campaign::Row>& rows);

}  // namespace whisker::page
