#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace fenestra {

/// A store's description of itself: the study as written and as resolved, version, seed, libraries.
/// Free keys; "schema_version" is written by the store.
using StoreMetadata = std::map<std::string, std::string>;

/// One call of the program that added trials to a store.
struct RunEntry {
  std::string shard = "1/1";
  std::string started_utc = "";                         ///< "2026-01-31T12:00:00Z"
  std::optional<std::string> ended_utc = std::nullopt;  ///< Absent: still running, or killed.
  int jobs = 1;
  std::string host = "";
  std::string processor = "";
  std::string command = "";
};

/// How often a detector has found the target so far.
struct DetectorTally {
  std::string detector;
  int64_t in_view = 0;  ///< Rows whose target is in view (see CellSummary).
  int64_t hits = 0;
};

}  // namespace fenestra
