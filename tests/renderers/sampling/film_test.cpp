#include "renderers/sampling/film.h"

#include <gtest/gtest.h>

namespace fenestra {
namespace {

TEST(FilmTest, QuartersFollowASlopeUpToAnEdgeAndNotAcrossIt) {
  Film film(12, 5, 1);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 12; ++column) {
      Film::PixelResult pixel{.radiance = {}, .key = column < 8 ? 1u : 2u};
      pixel.radiance[0] =
          column < 8 ? 2.0f * static_cast<float>(column) + static_cast<float>(row) : 1000.0f;
      film.Set({column, row}, pixel);
    }
  }
  film.MarkEdges();
  const QuarterImages quarters = film.TakeQuarters();
  const auto quarter = [&](size_t q, int column) { return quarters[q].at<float>(2, column); };
  // A quarter's centre is 1/4 px off in each direction.
  EXPECT_FLOAT_EQ(quarter(0, 3), 8.0f - 0.5f - 0.25f);
  EXPECT_FLOAT_EQ(quarter(1, 3), 8.0f + 0.5f - 0.25f);
  EXPECT_FLOAT_EQ(quarter(2, 3), 8.0f - 0.5f + 0.25f);
  EXPECT_FLOAT_EQ(quarter(3, 3), 8.0f + 0.5f + 0.25f);
  // The last pixel before the edge and the one before it, which has it for a neighbour.
  EXPECT_FLOAT_EQ(quarter(0, 7), 16.0f);
  EXPECT_FLOAT_EQ(quarter(1, 6), 14.0f - 0.25f);
  EXPECT_FLOAT_EQ(quarter(1, 9), 1000.0f);
}

}  // namespace
}  // namespace fenestra
