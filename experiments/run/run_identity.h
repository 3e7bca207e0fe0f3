#pragma once

#include <string>
#include <vector>

#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace fenestra {

/// "Embree 3.13.5, OpenCV 4.6.0, PCL 1.13.0, ...": the libraries in use, as they report themselves.
std::string LibraryVersions();

/// Everything that the bits of a study's rows depend on. All rows of one store, and of the shards
/// that are merged into one, share it: a run goes on, and shards are merged, only where nothing of
/// it differs, since rows that differ in their last bits could not be told from each other
/// afterwards.
struct RunIdentity {
  std::string study;      ///< Resolved, as YAML; the seed is in it.
  std::string version;    ///< Of Fenestra: "0.1.0".
  std::string build;      ///< The linker's hash of the program.
  std::string libraries;  ///< See LibraryVersions.
  std::string instruction_set;
  std::string plugins;  ///< Shared libraries with detectors: "libmine.so 5f3a…, …".
};

/// The identity of a study's rows when this program runs it on this machine.
RunIdentity IdentityOf(const Study& study);

/// Writes an identity into a store's metadata, and reads it. Each field has an entry of its name;
/// one that is missing, as in the results of an older program, is empty and thus differs wherever
/// this program has something to say.
void AddTo(StoreMetadata& metadata, const RunIdentity& identity);
RunIdentity IdentityFrom(const StoreMetadata& metadata);

/// The differences, one line each: "version: 0.1.0 there, 0.2.0 here"; for the study, the lines
/// that differ. Empty if nothing differs.
std::vector<std::string> Differences(const RunIdentity& there, const RunIdentity& here);

}  // namespace fenestra
