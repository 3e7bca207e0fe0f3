#include "experiments/report/envelope_report.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "tests/experiments/study_file/study_text.h"

namespace fenestra {
namespace {

// A study that looks for the largest distance, for each azimuth and each kind of scene.
Study EnvelopeStudy() {
  return ReadText(
      "name: test\nrepetitions: 100\nsensors: [stereo]\nfactors:\n"
      "  distance_m: [2, 4, 6, 8]\n  azimuth_deg: [0, 20, 40]\n"
      "envelope: {over: distance_m, require: {hit_rate: 0.9}}\n");
}

EnvelopeCurve Curve(double azimuth_deg, const std::string& detector,
                    std::vector<HoldingRange> holds) {
  EnvelopeCurve envelope;
  envelope.curve.part = "main";
  envelope.curve.others = {{"azimuth_deg", azimuth_deg}};
  envelope.curve.level = {2.0, 4.0, 6.0, 8.0};
  envelope.detector = detector;
  envelope.holds = std::move(holds);
  return envelope;
}

std::vector<EnvelopeCurve> Curves(const std::string& detector = "paper-stereo") {
  return {Curve(0.0, detector, {{.from = 2.0, .to = 8.0, .fails_below = {}, .fails_above = {}}}),
          Curve(20.0, detector, {{.from = 2.0, .to = 6.0, .fails_below = {}, .fails_above = 8.0}}),
          Curve(40.0, detector, {{.from = 2.0, .to = 4.0, .fails_below = {}, .fails_above = 6.0}})};
}

// Pixels of colours that are neither black, white nor grey: what is drawn of detectors.
size_t ColoredPixels(const cv::Mat3b& picture) {
  size_t count = 0;
  for (const cv::Vec3b& pixel : picture) {
    const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
    count += most - least > 60;
  }
  return count;
}

TEST(EnvelopePicture, IsOnePanelForOneSetOfOtherLevels) {
  const Study study = EnvelopeStudy();
  const auto picture = EnvelopePicture(study, Curves());
  ASSERT_TRUE(picture.has_value());
  std::vector<EnvelopeCurve> two_panels = Curves();
  for (EnvelopeCurve& envelope : two_panels) envelope.curve.others.emplace_back("glass", true);
  for (EnvelopeCurve envelope : Curves()) {
    envelope.curve.others.emplace_back("glass", false);
    two_panels.push_back(envelope);
  }
  const auto wide = EnvelopePicture(study, two_panels);
  ASSERT_TRUE(wide.has_value());
  EXPECT_EQ(wide->cols, 2 * picture->cols);
  EXPECT_EQ(wide->rows, picture->rows);
}

TEST(EnvelopePicture, EachDetectorHasAColourOfItsOwn) {
  const Study study = EnvelopeStudy();
  std::vector<EnvelopeCurve> both = Curves("a");
  for (EnvelopeCurve envelope : Curves("b")) {
    envelope.holds.front().to = 4.0;
    both.push_back(envelope);
  }
  const auto colors = [](const cv::Mat3b& picture) {
    std::set<std::tuple<int, int, int>> found;
    for (const cv::Vec3b& pixel : picture) {
      const auto [least, most] = std::minmax({pixel[0], pixel[1], pixel[2]});
      // Without what anti-aliasing mixes with white.
      if (most - least > 100) found.insert({pixel[0] / 64, pixel[1] / 64, pixel[2] / 64});
    }
    return found.size();
  };
  EXPECT_GT(colors(*EnvelopePicture(study, both)), colors(*EnvelopePicture(study, Curves("a"))));
}

TEST(EnvelopePicture, WhereNothingHoldsThereIsNoBoundary) {
  const Study study = EnvelopeStudy();
  std::vector<EnvelopeCurve> nowhere = Curves();
  for (EnvelopeCurve& envelope : nowhere) envelope.holds.clear();
  const auto with = EnvelopePicture(study, Curves());
  const auto without = EnvelopePicture(study, nowhere);
  ASSERT_TRUE(with && without);
  // The legend still names the detector, in its colour.
  EXPECT_GT(ColoredPixels(*without), 0u);
  EXPECT_GT(ColoredPixels(*with), ColoredPixels(*without) + 100u);
}

TEST(EnvelopePicture, ANearBoundaryIsDrawnWhereItIsNotTheFirstLevel) {
  const Study study = EnvelopeStudy();
  std::vector<EnvelopeCurve> with_near = Curves();
  for (EnvelopeCurve& envelope : with_near) {
    envelope.holds.front().from = 4.0;
    envelope.holds.front().fails_below = 2.0;
  }
  EXPECT_GT(ColoredPixels(*EnvelopePicture(study, with_near)),
            ColoredPixels(*EnvelopePicture(study, Curves())) + 50u);
}

TEST(EnvelopePicture, WithoutAnotherNumberThereIsNone) {
  const Study study = EnvelopeStudy();
  EXPECT_FALSE(EnvelopePicture(study, {}));
  const std::vector<EnvelopeCurve> one = {Curves().front()};
  EXPECT_FALSE(EnvelopePicture(study, one));
  std::vector<EnvelopeCurve> words = Curves();
  for (size_t i = 0; i < words.size(); ++i) {
    words[i].curve.others = {{"scene", std::string(i == 0 ? "facade" : "paper_target")}};
  }
  EXPECT_FALSE(EnvelopePicture(study, words));
}

}  // namespace
}  // namespace fenestra
