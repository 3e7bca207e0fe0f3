#include "experiments/cli/plugins.h"

#include "vision/plugin_loader.h"

namespace fenestra::cli {

void AddPluginOption(Command command, std::vector<std::filesystem::path>& plugins) {
  command
      .AddOption("--plugin", plugins, "Shared library with detectors; may be given several times")
      .TypeName("LIBRARY")
      .OneValueEach();
}

void LoadPlugins(const std::vector<std::filesystem::path>& plugins) {
  for (const std::filesystem::path& plugin : plugins) LoadPlugin(plugin);
}

std::shared_ptr<DetectorMaker> MakerWith(const std::vector<std::filesystem::path>& plugins) {
  std::vector<std::string> serve = {std::filesystem::read_symlink("/proc/self/exe").string(),
                                    "serve"};
  for (const std::filesystem::path& plugin : plugins) {
    serve.push_back("--plugin");
    serve.push_back(std::filesystem::absolute(plugin).string());
  }
  return std::make_shared<DetectorMaker>(serve);
}

}  // namespace fenestra::cli
