#include <fmt/format.h>

#include <filesystem>

#include "core/io/image_io.h"
#include "core/io/temporary_files.h"
#include "experiments/cli/commands.h"
#include "experiments/depth_curves/depth_curves_picture.h"
#include "experiments/depth_curves/depth_curves_report.h"

namespace fenestra::cli {

void AddDepthCommand(Command program) {
  Command command = program.AddCommand(
      "depth", "Measures the RGB-D sensor's depth before walls, beside published curves");
  command.Footer(
      "Example:\n"
      "  fenestra depth /tmp/depth\n"
      "Noise by distance and angle, of depth and of borders, the steps of depth, shadows, and "
      "which\n"
      "share of pixels returns by ambient light and paint, for both models of the sensor, beside "
      "what\n"
      "is published and what the constants predict. Takes about two minutes.");
  const auto folder = std::make_shared<std::filesystem::path>();
  const auto seed = std::make_shared<uint64_t>(1);
  command.AddOption("DIR", *folder, "Folder for tables and pictures").Required();
  command.AddOption("--seed", *seed, "Of the noise").ShowDefault();
  command.Action([folder, seed] {
    const OutputPath out = OutputPath::Folder(*folder);
    out.RequireWritable();
    out.RequireFree({"depth_curves.md", "depth_curves.png"});
    StructuredLightOptions options;
    options.driver = DepthDriver::kOpenNi;  // The farther of the two, as in the recordings.
    const DepthCurves parametric = MeasureDepthCurves(options, RandomStream(*seed));
    options.depth_model = DepthModel::kMatched;
    const DepthCurves speckle = MeasureDepthCurves(options, RandomStream(*seed));
    const std::string report = DepthCurvesMarkdown(options, parametric, speckle);
    WriteFileAtomically(out / "depth_curves.md", report);
    WritePng(out / "depth_curves.png", DepthCurvesPicture(parametric, speckle));
    fmt::print("{}\nIn {}: depth_curves.md, depth_curves.png\n", report, folder->string());
    return kDone;
  });
}

}  // namespace fenestra::cli
