#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fenestra {

/// Loads a shared library (see detector_plugin.h), registers its detectors and returns how many
/// there are. They run isolated unless a study says otherwise. The library stays loaded. Call it
/// before detectors are used, from one thread.
///
/// Throws InputError, and then none of its detectors is registered, for a file that is missing or
/// cannot be loaded, is no plugin, was built against another interface, registers no detector, or
/// one whose name is taken, or throws while it does so.
int LoadPlugin(const std::filesystem::path& library);

/// A library that LoadPlugin has loaded.
struct LoadedPlugin {
  std::string name;      ///< Of its file: "libmine.so".
  std::string build_id;  ///< See BuildIdAt.
};
const std::vector<LoadedPlugin>& LoadedPlugins();

}  // namespace fenestra
