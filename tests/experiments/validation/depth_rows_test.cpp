#include "experiments/validation/validation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fenestra::validation {
namespace {

const std::filesystem::path kRecordings = FENESTRA_SOURCE_DIR "/tests/data";

std::vector<Row> RowsOf(const std::vector<Row>& rows, const std::string& phenomenon) {
  std::vector<Row> some;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some),
               [&](const Row& row) { return row.phenomenon.starts_with(phenomenon); });
  return some;
}

size_t Misfits(const std::vector<Row>& rows) {
  return static_cast<size_t>(std::count_if(
      rows.begin(), rows.end(), [](const Row& row) { return row.verdict == Verdict::kMisfit; }));
}

TEST(DepthRowsTest, TheModelHoldsButForTheFloorThatIsTooBright) {
  const std::vector<Row> rows = DepthRows(kRecordings);
  EXPECT_EQ(RowsOf(rows, "step of depth").size(), 1u);
  EXPECT_GE(RowsOf(rows, "axial noise").size(), 6u);
  EXPECT_GE(RowsOf(rows, "correlation").size(), 6u);
  EXPECT_EQ(RowsOf(rows, "pixels with a return").size(), RecordedPlanes().size());
  EXPECT_EQ(RowsOf(rows, "range at which half").size(), 1u);
  EXPECT_GE(RowsOf(rows, "smooth error").size(), 6u);
  for (const Row& row : rows) {
    const bool too_bright = row.phenomenon == "pixels with a return: region_growing_rgb far floor";
    EXPECT_EQ(row.verdict == Verdict::kMisfit, too_bright)
        << row.phenomenon << ": " << row.recorded << ", " << row.simulated << ", " << row.agreement;
  }
}

// With a quarter of the speckle walls are too smooth; with Landau's residuals for noise in the dark
// floors are lost.
TEST(DepthRowsTest, AWrongSensorIsAMisfit) {
  StructuredLightOptions smooth = SensorOfRecordings();
  smooth.infrared.speckle_contrast /= 4.0;
  smooth.infrared.speckle_flicker /= 4.0;
  const std::vector<Row> noise = RowsOf(DepthRows(kRecordings, smooth), "axial noise");
  EXPECT_GE(2 * Misfits(noise), noise.size());

  StructuredLightOptions noisy = SensorOfRecordings();
  noisy.infrared.dark_noise_dn = 10.4;
  const std::vector<Row> rows = DepthRows(kRecordings, noisy);
  EXPECT_GE(Misfits(RowsOf(rows, "pixels with a return")), 3u);
  EXPECT_EQ(Misfits(RowsOf(rows, "range at which half")), 1u);
}

}  // namespace
}  // namespace fenestra::validation
