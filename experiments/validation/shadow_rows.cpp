#include "experiments/validation/validation.h"

#include <fmt/format.h>

#include "experiments/depth_curves/wall_setup.h"
#include "experiments/validation/recorded_planes.h"

namespace fenestra::validation {
namespace {

// Between the head's widest rows; shoulders begin below.
const cv::Range kHead(180, 261);
constexpr double kNearerThan_m = 1.0;

Row RowOf(const char* phenomenon, const OutlineHoles& real, Origin origin) {
  return {.phenomenon = fmt::format("shadow of a head at {:.2f} m before a wall at {:.1f} m: {}",
                                    real.near_m, real.beyond_m, phenomenon),
          .recording = "depth-pcl/person-depth.png (PointCloudLibrary, BSD-3), registered",
          .origin = origin};
}

}  // namespace

std::vector<Row> ShadowRows(const std::filesystem::path& recordings,
                            const StructuredLightOptions& options) {
  const DepthView person = ViewOf(RecordedPlanes().front(), recordings);
  const OutlineHoles real = MeasureOutlines(person, kHead, kNearerThan_m);
  StructuredLightOptions registering = options;
  registering.registered_depth = true;
  const WallSetup wall(registering, WallSetup::kWhite,
                       {.stand_off_m = real.beyond_m - real.near_m,
                        .half_width_m = real.near_m * real.half_width_px / person.focal_px},
                       RandomStream(1));
  const DepthImage depth = wall.See({.distance_m = real.beyond_m});
  DepthView view{cv::Mat1d(), person.focal_px, person.centre_px};
  depth.raw.convertTo(view.z_m, CV_64F, depth.unit_m);
  const OutlineHoles ours = MeasureOutlines(view, kHead, kNearerThan_m);

  const auto share = [](const OutlineHoles& holes) {
    return Estimated{holes.left_px.value / holes.both_px.value,
                     holes.left_px.error / holes.both_px.value};
  };
  std::vector<Row> rows = {RowOf("holes of a row on both sides", real, Origin::kFitted),
                           RowOf("their share on the left", real, Origin::kPredicted)};
  const double geometry_px =
      person.focal_px * options.projector_baseline_m * (1.0 / real.near_m - 1.0 / real.beyond_m);
  rows[0].recorded =
      Text(real.both_px, "px", 1) + fmt::format("; {:.1f} px by geometry", geometry_px);
  rows[0].simulated = Text(ours.both_px, "px", 1);
  JudgeRatio(rows[0], real.both_px, ours.both_px, 0.0);
  rows[1].recorded = Text(share(real), "");
  rows[1].simulated = Text(share(ours), "");
  JudgeRatio(rows[1], share(real), share(ours), 0.0);
  return rows;
}

}  // namespace fenestra::validation
