/// Runs and campaigns as one self-contained file for a browser. docs/pages.md describes the format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/harness/run/run_log.hpp"
#include "host/lab/campaign/row.hpp"
#include "host/lab/report/fuzzy_picture.hpp"

namespace whisker::page {

/// A run as the page stores it.
struct StoredRun {
  std::string json;     ///< one object: world, robot, verdict, columns
  std::string columns;  ///< base64 of the deflated columns
};

StoredRun stored(const RunLog& log);

/// The active response table, for the page.
using Controller = report::FuzzyPicture;

std::string run_page(const StoredRun& run, const Controller& controller);

/// The page without a run: it follows a running one through the events at this address of its own server.
/// Only this page may contact a server.
std::string live_page(const std::string& events, const Controller& controller);

/// A mission of the campaign that the page can replay.
struct Replay {
  std::size_t row;  ///< index into the rows
  StoredRun run;
};

/// At least one row.
std::string campaign_page(const std::vector<campaign::Row>& rows, const std::vector<Replay>& replays,
                          const Controller& controller);

/// Indices of the most interesting rows, at most `most`: contacts, faults, other failures, those farthest off
/// a goal that they report as reached, then the longest paths relative to the shortest; equal ones in the
/// order of the rows.
std::vector<std::size_t> worst(const std::vector<campaign::Row>& rows, std::size_t most);

}  // namespace whisker::page
