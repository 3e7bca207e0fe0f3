#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fenestra {

/// Loads a shared library (see detector_plugin.h), registers its detectors and returns their
/// number. They run in separate processes unless a study says otherwise. The library stays loaded.
/// Call it before detectors are used, from one thread.
///
/// Throws InputError, without registering any detector, if the file is missing, cannot be loaded,
/// is not a plugin or was built against another interface, or if it registers no detector,
/// registers one whose name is taken, or throws while registering.
int LoadPlugin(const std::filesystem::path& library);

/// A library that LoadPlugin has loaded.
struct LoadedPlugin {
  std::string name;      ///< Name of its file, such as "libmine.so".
  std::string build_id;  ///< See BuildIdAt.
};
const std::vector<LoadedPlugin>& LoadedPlugins();

}  // namespace fenestra
