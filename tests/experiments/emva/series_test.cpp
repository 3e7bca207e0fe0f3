#include "experiments/emva/series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "experiments/emva/simulated_series.h"
#include "tests/support/temporary_folder.h"

namespace fenestra::emva {
namespace {

using fenestra::testing::TemporaryFolder;
using ::testing::HasSubstr;

const SimulationOptions kTiny{.size = {16, 12}, .exposures = 12, .frames = 4};

TEST(EmvaSeriesTest, ADescriptorReadsBackAsItWasWritten) {
  const TemporaryFolder folder;
  ImageSensorOptions sensor;
  sensor.output_bits = 10;
  const Series series = PlanSeries(kTiny, sensor);
  const Series back = ReadDescriptor(folder.Write("emva1288.txt", ToDescriptor(series)));
  EXPECT_EQ(back.bits, 10);
  EXPECT_EQ(back.size, series.size);
  ASSERT_EQ(back.sets.size(), series.sets.size());
  for (size_t i = 0; i < series.sets.size(); ++i) {
    EXPECT_NEAR(back.sets[i].exposure_s, series.sets[i].exposure_s, 1e-12);
    EXPECT_NEAR(back.sets[i].photons, series.sets[i].photons, 1e-5);
    EXPECT_EQ(back.sets[i].files, series.sets[i].files);
  }
}

TEST(EmvaSeriesTest, FramesReadBackAsTheyWereTaken) {
  for (const int bits : {8, 10}) {
    const TemporaryFolder folder;
    ImageSensorOptions sensor;
    sensor.output_bits = bits;
    const Series series = PlanSeries(kTiny, sensor);
    const ImageReader taken = Simulate(kTiny, sensor, RandomStream(1));
    const auto descriptor = WriteSeries(folder.path(), series, taken);
    const ImageReader files = FilesBeside(descriptor, series);
    for (const ImageSet& set : series.sets) {
      EXPECT_EQ(cv::norm(files(set, 1), taken(set, 1), cv::NORM_INF), 0.0);
    }
  }
}

TEST(EmvaSeriesTest, AllFaultsOfADescriptorAreReportedWithTheirLines) {
  const TemporaryFolder folder;
  const auto file = folder.Write("emva1288.txt",
                                 "v 4.0\n"
                                 "n 8 752 480\n"
                                 "b 1000,5 200\n"  // A decimal comma is fine.
                                 "i images\\a.png\n"
                                 "i images\\b.png\n"
                                 "d 1000.5\n"
                                 "i images\\c.png\n"
                                 "x 3\n"
                                 "b ten 200\n");
  try {
    ReadDescriptor(file);
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 3u);
    EXPECT_EQ(error.faults()[0].line, 8);
    EXPECT_EQ(error.faults()[1].line, 9);
    EXPECT_THAT(error.faults()[1].message, HasSubstr("'ten'"));
    EXPECT_EQ(error.faults()[2].line, 6);
    EXPECT_THAT(error.faults()[2].message, HasSubstr("needs two files"));
  }
}

TEST(EmvaSeriesTest, FramesThatDoNotFitAreRefusedByName) {
  const TemporaryFolder folder;
  ImageSensorOptions sensor;
  sensor.output_bits = 10;
  const Series series = PlanSeries(kTiny, sensor);
  const auto descriptor =
      WriteSeries(folder.path(), series, Simulate(kTiny, sensor, RandomStream(1)));
  const auto message = [&](const Series& told, const ImageSet& set) {
    try {
      FilesBeside(descriptor, told)(set, 0);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  Series larger = series;
  larger.size.width += 1;
  EXPECT_THAT(message(larger, series.sets[0]), HasSubstr("16 x 12 px"));
  Series eight = series;
  eight.bits = 8;
  const ImageSet& brightest = *(series.sets.end() - 4);
  EXPECT_THAT(message(eight, brightest), HasSubstr("too many for 8 bits"));
  ImageSet missing = series.sets[0];
  missing.files[0] = "images/none.png";
  EXPECT_THAT(message(series, missing), HasSubstr("none.png"));
}

}  // namespace
}  // namespace fenestra::emva
