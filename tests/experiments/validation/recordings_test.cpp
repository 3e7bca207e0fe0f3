// What the structured-light sensor delivers of planes that real sensors have recorded.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/validation/simulated_planes.h"

namespace fenestra::validation {
namespace {

const std::filesystem::path kRecordings = FENESTRA_SOURCE_DIR "/tests/data";
constexpr int kLeastPixels = 500;  // Of a bin that is judged.

// Within 0.1 beside what few blocks tell: 2.5 standard errors of their difference, of some 40
// figures.
void ExpectAlike(const Estimated& simulated, const Estimated& recorded) {
  EXPECT_NEAR(simulated.value, recorded.value,
              0.1 + 2.5 * std::hypot(simulated.error, recorded.error));
}

// Nothing of the noise was fitted to a recording: its size and its correlation follow from
// the contrast of speckle (Landau 2015) and the blocks' size.
TEST(RecordingsTest, NoiseOfPlanesAndItsCorrelationAreAsRecorded) {
  int planes = 0;
  for (const RecordedPlane& recorded : RecordedPlanes()) {
    const PlaneComparison c = Compare(recorded, kRecordings);
    if (c.recorded.blocks < 8 || c.simulated.blocks < 8) continue;
    ++planes;
    SCOPED_TRACE(recorded.name);
    EXPECT_NEAR(c.simulated.noise_steps.value / c.recorded.noise_steps.value, 1.0, 0.25);
    for (size_t lag = 0; lag < 3; ++lag) {
      ExpectAlike(c.simulated.along_rows[lag], c.recorded.along_rows[lag]);
      ExpectAlike(c.simulated.along_columns[lag], c.recorded.along_columns[lag]);
    }
  }
  EXPECT_GE(planes, 6);
  // The twin: with a quarter of the contrast a wall is too smooth.
  StructuredLightOptions smooth = SensorOfRecordings();
  smooth.infrared.speckle_contrast /= 4.0;
  smooth.infrared.speckle_flicker /= 4.0;
  const PlaneComparison c = Compare(RecordedPlanes().front(), kRecordings, smooth);
  EXPECT_LT(c.simulated.noise_steps.value / c.recorded.noise_steps.value, 0.75);
}

// The dark noise was fitted to freiburg2's floor alone; the others are predicted.
TEST(RecordingsTest, AsManyPixelsReturnAsRecorded) {
  // A floor at 78° that returns to 3.8 m as no other does: brighter than assumed, perhaps.
  const std::string too_bright = "region_growing_rgb far floor";
  int bins = 0;
  for (const RecordedPlane& recorded : RecordedPlanes()) {
    const PlaneComparison c = Compare(recorded, kRecordings);
    for (const auto& [place, bin] : c.recorded.bins) {
      const auto simulated = c.simulated.bins.find(place);
      if (bin.pixels < kLeastPixels || simulated == c.simulated.bins.end()) continue;
      if (recorded.name == too_bright && place.first >= 3.5) continue;
      ++bins;
      EXPECT_NEAR(100.0 * simulated->second.Share(), 100.0 * bin.Share(), 10.0)
          << recorded.name << " from " << place.first << " m, " << place.second << " deg";
    }
  }
  EXPECT_GE(bins, 40);
  // The twin: Landau's residuals, taken for the noise in the dark, lose the floor.
  StructuredLightOptions noisy = SensorOfRecordings();
  noisy.infrared.dark_noise_dn = 10.4;
  for (const RecordedPlane& recorded : RecordedPlanes()) {
    if (recorded.name != "freiburg2 floor") continue;
    const PlaneComparison c = Compare(recorded, kRecordings, noisy);
    EXPECT_LT(c.simulated.bins.at({4.0, 65.0}).Share(), 0.1);
  }
}

// The warp's size and scale were fitted to these planes, by two units at least.
TEST(RecordingsTest, PlanesAreAsWarpedAsRecordedWithinAFactorOfTwo) {
  double log_ratios = 0.0;
  double log_ratios_without = 0.0;
  int planes = 0;
  for (const RecordedPlane& recorded : RecordedPlanes()) {
    const DepthView real = ViewOf(recorded, kRecordings);
    const cv::Mat1b mask = MaskIn(recorded, real);
    if (Measure(real, mask, FitPlane(real, mask), recorded.step).blocks < 8) continue;
    const SmoothErrors errors =
        CompareSmoothErrors(recorded, kRecordings, UnitDeviations::Calibrated().disparity_warp_px);
    RecordProperty(recorded.name,
                   fmt::format("{:.2f} recorded, {:.2f}", errors.recorded, errors.simulated));
    EXPECT_NEAR(std::log2(errors.simulated / errors.recorded), 0.0, 1.2) << recorded.name;
    log_ratios += std::log2(errors.simulated / errors.recorded);
    log_ratios_without +=
        std::log2(std::max(0.01, CompareSmoothErrors(recorded, kRecordings, 0.0).simulated) /
                  errors.recorded);
    ++planes;
  }
  EXPECT_GE(planes, 5);
  EXPECT_NEAR(log_ratios / planes, 0.0, 0.5);
  // The twin: a unit without a warp.
  EXPECT_LT(log_ratios_without / planes, -1.0);
}

}  // namespace
}  // namespace fenestra::validation
