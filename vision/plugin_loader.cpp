#include "vision/plugin_loader.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <set>
#include <utility>
#include <vector>

#include "core/io/input_error.h"
#include "core/system/program.h"
#include "vision/detector_plugin.h"
#include "vision/detector_registry.h"

namespace fenestra {
namespace {

class Collector : public DetectorRegistrar {
 public:
  void Add(const DetectorInfo& info, const DetectorFactory& make) override {
    collected_.emplace_back(info, make);
    collected_.back().first.isolate = true;
  }
  const std::vector<std::pair<DetectorInfo, DetectorFactory>>& collected() const {
    return collected_;
  }

 private:
  std::vector<std::pair<DetectorInfo, DetectorFactory>> collected_;
};

void* Open(const std::filesystem::path& library) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(library, error)) {
    throw InputError(library, "there is no such file");
  }
  // The path is made absolute, since dlopen looks for a bare name among the system's libraries.
  void* const handle = dlopen(std::filesystem::absolute(library).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw InputError(library, fmt::format("cannot be loaded: {}", dlerror()));
  }
  return handle;
}

template <typename Function>
Function* Find(const std::filesystem::path& library, void* handle, const char* name) {
  void* const symbol = dlsym(handle, name);
  if (symbol == nullptr) {
    throw InputError(library, fmt::format("is not a plugin of Fenestra: it has no {}; see "
                                          "FENESTRA_DETECTOR_PLUGIN in vision/detector_plugin.h",
                                          name));
  }
  return reinterpret_cast<Function*>(symbol);
}

void CheckNames(const std::filesystem::path& library, const Collector& collector) {
  if (collector.collected().empty()) throw InputError(library, "registers no detector");
  std::set<std::string> names;
  for (const auto& [info, make] : collector.collected()) {
    if (!IsDetectorName(info.name)) {
      throw InputError(library, fmt::format("registers a detector '{}': names are 1 to 64 of the "
                                            "characters a-z 0-9 _ -",
                                            info.name));
    }
    if (FindDetector(info.name) != nullptr || !names.insert(info.name).second) {
      throw InputError(library, fmt::format("registers a detector '{}', but there is one of that "
                                            "name already",
                                            info.name));
    }
  }
}

std::vector<LoadedPlugin>& MutablePlugins() {
  static std::vector<LoadedPlugin> plugins;
  return plugins;
}

}  // namespace

int LoadPlugin(const std::filesystem::path& library) {
  void* const handle = Open(library);
  const std::string theirs = Find<const char*()>(library, handle, "fenestra_plugin_interface")();
  if (const std::string ours = PluginInterface(); theirs != ours) {
    throw InputError(library, fmt::format("was built against another interface: build it again.\n"
                                          "  plugin:  {}\n  program: {}",
                                          theirs, ours));
  }
  const auto fill = Find<void(DetectorRegistrar&)>(library, handle, "fenestra_plugin_register");
  Collector collector;
  try {
    fill(collector);
  } catch (const std::exception& error) {
    throw InputError(library, fmt::format("cannot register its detectors: {}", error.what()));
  }
  CheckNames(library, collector);
  for (const auto& [info, make] : collector.collected()) RegisterDetector(info, make);
  MutablePlugins().push_back({.name = library.filename().string(),
                              .build_id = BuildIdAt(reinterpret_cast<const void*>(fill))});
  return static_cast<int>(collector.collected().size());
}

const std::vector<LoadedPlugin>& LoadedPlugins() {
  return MutablePlugins();
}

}  // namespace fenestra
