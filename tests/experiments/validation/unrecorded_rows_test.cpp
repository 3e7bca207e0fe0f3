#include "experiments/validation/validation.h"

#include <gtest/gtest.h>

#include "experiments/validation/simulated_planes.h"

namespace fenestra::validation {
namespace {

// Left borders are rougher than recorded ones, and the right one of a turned plate is by a fifth.
Verdict Expected(const std::string& phenomenon) {
  for (const char* unjudged : {"black paint", "daylight"}) {
    if (phenomenon.starts_with(unjudged)) return Verdict::kNotJudged;
  }
  const bool rough = phenomenon.starts_with("roughness") &&
                     phenomenon != "roughness of upright borders, right of a plate at 0°";
  return rough ? Verdict::kMisfit : Verdict::kHolds;
}

TEST(UnrecordedRowsTest, NothingIsJudgedThatWasNotRecorded) {
  const std::vector<Row> rows = UnrecordedDepthRows(SensorOfRecordings());
  EXPECT_EQ(rows.size(), 12u);
  for (const Row& row : rows) {
    EXPECT_EQ(row.verdict, Expected(row.phenomenon)) << row.phenomenon << ": " << row.simulated;
  }
}

// The twin: a laser whose speckle is another one in each image.
TEST(UnrecordedRowsTest, SpeckleThatFlickersIsNoiseInTime) {
  StructuredLightOptions flickering = SensorOfRecordings();
  flickering.infrared.speckle_flicker = flickering.infrared.speckle_contrast;
  for (const Row& row : UnrecordedDepthRows(flickering)) {
    if (!row.phenomenon.starts_with("noise in time")) continue;
    EXPECT_EQ(row.verdict, Verdict::kMisfit) << row.phenomenon << ": " << row.simulated;
  }
}

}  // namespace
}  // namespace fenestra::validation
