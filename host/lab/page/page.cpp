#include "host/lab/page/page.hpp"

#include "host/lab/campaign/failures.hpp"
#include "host/lab/page/guard_recording.hpp"
#include "host/lab/page/json.hpp"
#include "host/lab/page/template.hpp"
#include "host/lab/report/svg.hpp"

namespace whisker::page {
namespace {

std::string data_element(const Json& data) {
  return "<script type=\"application/json\" id=\"data\">" + report::script_safe(text_of(data)) +
         "</script>\n";
}

std::string columns_element(std::size_t index, const std::string& columns) {
  return "<script type=\"text/plain\" id=\"columns-" + std::to_string(index) + "\">" + columns +
         "</script>\n";
}

std::string filled(const std::string& data) {
  std::string page;
  for (const std::string_view part : template_parts()) page += part;
  report::put(page, kDataMark, data);
  return page;
}

std::string page_of(const StoredRun& run, const Json& shared) {
  Json data = {{"format", 1}, {"shared", shared}};
  data["runs"] = Json::array({Json::parse(run.json)});
  return filled(data_element(data) + columns_element(0, run.columns));
}

}  // namespace

std::string text_of(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

std::string live_page(const std::string& events, const Controller& controller) {
  const Json data = {
      {"format", 1}, {"shared", shared_data(controller)}, {"runs", Json::array()}, {"live", events}};
  std::string page = filled(data_element(data));
  report::put(page, kPolicy, std::string(kPolicy) + " connect-src 'self';");
  return page;
}

std::string run_page(const StoredRun& run, const Controller& controller) {
  return page_of(run, shared_data(controller));
}

std::string guard_page(const StoredRun& drive) { return page_of(drive, names_data()); }

std::string campaign_page(const std::vector<campaign::Row>& rows, const std::vector<Replay>& replays,
                          const Controller& controller) {
  Json data = {{"format", 1}, {"shared", shared_data(controller)}, {"runs", Json::array()}};
  data["campaign"] = campaign_data(rows);
  data["campaign"]["order"] = worst(rows, rows.size());
  Json& commands = data["campaign"]["commands"] = Json::array();
  for (const campaign::Row& row : rows) commands.push_back(campaign::replay_command(row));
  for (const Replay& replay : replays) commands[replay.row] = nullptr;
  std::string columns;
  for (std::size_t i = 0; i < replays.size(); ++i) {
    Json run = Json::parse(replays[i].run.json);
    run["row"] = replays[i].row;
    run["command"] = campaign::replay_command(rows[replays[i].row]);
    data["runs"].push_back(run);
    columns += columns_element(i, replays[i].run.columns);
  }
  return filled(data_element(data) + columns);
}

}  // namespace whisker::page
