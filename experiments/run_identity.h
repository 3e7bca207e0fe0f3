#pragma once

#include <string>
#include <vector>

#include "experiments/store.h"
#include "experiments/study.h"

namespace fenestra {

/// All that the bits of a study's rows depend on. Rows of one store, and of the shards that are
/// merged into one, have the same.
struct RunIdentity {
  std::string study;  ///< Resolved, as YAML; the seed is in it.
  std::string version;
  std::string build;
  std::string libraries;
  std::string instruction_set;
  std::string plugins;  ///< Shared libraries with detectors: "libmine.so 5f3a…, …".
};

/// Of a study that this program runs on this machine.
RunIdentity IdentityOf(const Study& study);

/// To and from the metadata of a store. An entry that is not there is empty.
void AddTo(StoreMetadata& metadata, const RunIdentity& identity);
RunIdentity IdentityFrom(const StoreMetadata& metadata);

/// What differs, one line each: "version: 0.1.0 there, 0.2.0 here". Of the study, the lines that
/// differ. Empty if nothing does.
std::vector<std::string> Differences(const RunIdentity& there, const RunIdentity& here);

}  // namespace fenestra
