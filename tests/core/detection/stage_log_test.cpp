#include "core/detection/stage_log.h"

#include <gtest/gtest.h>

namespace fenestra {
namespace {

TEST(StageLogTest, TimesAddUpAndPicturesDoNotCount) {
  double now = 0.0;
  StageLog log([&now] { return now; }, /*keep_artifacts=*/true);
  log.Begin("a");
  now = 1.0;
  log.Picture("p", [&now] {
    now = 10.0;
    return cv::Mat1b(1, 1);
  });
  now = 11.0;
  log.Begin("b");
  now = 14.0;
  log.Begin("a");
  now = 15.0;
  log.End();
  now = 99.0;
  ASSERT_EQ(log.times().size(), 2u);
  EXPECT_EQ(log.times()[0].stage, "a");
  EXPECT_DOUBLE_EQ(log.times()[0].seconds, 3.0);
  EXPECT_DOUBLE_EQ(log.times()[1].seconds, 3.0);
  EXPECT_DOUBLE_EQ(log.TotalSeconds(), 6.0);
  EXPECT_EQ(log.pictures().size(), 1u);
}

TEST(StageLogTest, WithoutArtifactsNothingIsDrawn) {
  StageLog log([] { return 0.0; });
  log.Picture("p", []() -> cv::Mat { throw std::logic_error("must not be called"); });
  log.Cloud("c", []() -> std::vector<Eigen::Vector3f> { throw std::logic_error("nor this"); });
  EXPECT_TRUE(log.pictures().empty());
}

}  // namespace
}  // namespace fenestra
