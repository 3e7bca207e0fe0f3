#include "sim/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/check.h"
#include "core/wide.h"

namespace fenestra {
namespace {

// Weights of the quarters left and right of the pixels' centres (or above and below), from the
// pixel `reach` before to that `reach` after.
struct HalfTaps {
  int reach = 0;
  std::vector<float> before;  // At k - 1/4 px, k from -reach to reach,
  std::vector<float> after;   // and at k + 1/4 px.
};

double Moment(const std::vector<double>& weights, double first, int power) {
  double moment = 0.0;
  for (size_t i = 0; i < weights.size(); ++i) {
    moment += weights[i] * std::pow(first + 0.5 * static_cast<double>(i), power);
  }
  return moment;
}

// A Gaussian averaged over a pixel, at half-pixel steps from -reach - 1/4; sum 1.
std::vector<double> GaussianOverPixel(double sigma_px, int reach) {
  std::vector<double> weights;
  for (int i = 0; i < 4 * reach + 2; ++i) {
    const double x = -reach - 0.25 + 0.5 * i;
    const double scale = 1.0 / (sigma_px * std::numbers::sqrt2);
    weights.push_back(std::erf((x + 0.5) * scale) - std::erf((x - 0.5) * scale));
  }
  const double sum = Moment(weights, 0.0, 0);
  for (double& weight : weights) weight /= sum;
  return weights;
}

HalfTaps TapsOf(double sigma_px) {
  FENESTRA_CHECK(sigma_px >= 0.0 && sigma_px <= 20.0, "blur must be between 0 and 20 px");
  const int reach = static_cast<int>(std::ceil(5.0 * sigma_px + 0.25));
  // Half-pixel steps tell a narrow Gaussian's variance a little wrong: find the one whose weights
  // have the wanted variance.
  const double variance = sigma_px * sigma_px + 1.0 / 16.0;
  const double first = -reach - 0.25;
  double low = 1e-3;
  double high = sigma_px + 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (Moment(GaussianOverPixel(middle, reach), first, 2) < variance ? low : high) = middle;
  }
  const std::vector<double> weights = GaussianOverPixel(low, reach);
  HalfTaps taps{.reach = reach, .before = {}, .after = {}};
  for (size_t i = 0; i < weights.size(); i += 2) {
    taps.before.push_back(static_cast<float>(weights[i]));
    taps.after.push_back(static_cast<float>(weights[i + 1]));
  }
  return taps;
}

FENESTRA_WIDE void AddScaled(const float* in, float weight, float* sum, int count) {
  for (int i = 0; i < count; ++i) sum[i] += weight * in[i];
}

// The column of quarters on one side of the pixels' centres, of one row of pixels: weighted over
// the rows around it, and replicated by `reach` at both ends.
void GatherColumn(const cv::Mat& upper, const cv::Mat& lower, const HalfTaps& taps, int row,
                  std::vector<float>& gathered) {
  std::fill(gathered.begin(), gathered.end(), 0.0f);
  float* inside = gathered.data() + taps.reach;
  for (int k = -taps.reach; k <= taps.reach; ++k) {
    const auto tap = static_cast<size_t>(k + taps.reach);
    const int from = row + k;
    // Beyond the border both halves repeat the outermost one.
    const cv::Mat& above = from >= upper.rows ? lower : upper;
    const cv::Mat& below = from < 0 ? upper : lower;
    const int inner = std::clamp(from, 0, upper.rows - 1);
    AddScaled(above.ptr<float>(inner), taps.before[tap], inside, upper.cols);
    AddScaled(below.ptr<float>(inner), taps.after[tap], inside, upper.cols);
  }
}

void Replicate(std::vector<float>& row, int reach, float first, float last) {
  std::fill_n(row.begin(), reach, first);
  std::fill_n(row.end() - reach, reach, last);
}

// One kernel over all quarters around each pixel.
cv::Mat1f GatherQuarters(const QuarterImages& quarters, const HalfTaps& taps) {
  const auto& [upper_left, upper_right, lower_left, lower_right] = quarters;
  cv::Mat1f pixels = cv::Mat1f::zeros(upper_left.size());
  const int width = pixels.cols;
  std::vector<float> left(static_cast<size_t>(width + 2 * taps.reach));
  std::vector<float> right(left.size());
  for (int row = 0; row < pixels.rows; ++row) {
    GatherColumn(upper_left, lower_left, taps, row, left);
    GatherColumn(upper_right, lower_right, taps, row, right);
    const float first = left[static_cast<size_t>(taps.reach)];
    const float last = right[static_cast<size_t>(taps.reach + width - 1)];
    Replicate(left, taps.reach, first, last);
    Replicate(right, taps.reach, first, last);
    for (int k = 0; k <= 2 * taps.reach; ++k) {
      const auto tap = static_cast<size_t>(k);
      AddScaled(left.data() + k, taps.before[tap], pixels[row], width);
      AddScaled(right.data() + k, taps.after[tap], pixels[row], width);
    }
  }
  return pixels;
}

// ρ² = 1 at the outer corners of the corner pixels.
double SquaredCornerDistance(cv::Size size) {
  return 0.25 * (static_cast<double>(size.width) * size.width +
                 static_cast<double>(size.height) * size.height);
}

// What a three-tap kernel does at each pixel of a row: variance a + b x², x from the centre.
struct RowVariance {
  float a;
  float b;
  float centre;
};

// out = in + variance/2 (before - 2 in + after).
FENESTRA_WIDE void Spread(const float* before, const float* in, const float* after, float* out,
                          int first, int last, const RowVariance& variance) {
  for (int u = first; u < last; ++u) {
    const float x = static_cast<float>(u) - variance.centre;
    const float half = 0.5f * (variance.a + variance.b * x * x);
    out[u] = in[u] + half * (before[u] - 2.0f * in[u] + after[u]);
  }
}

// One three-tap kernel along the rows and one along the columns, of variance peak ρ² each.
void SpreadOnce(cv::Mat1f& image, double peak) {
  const float b = static_cast<float>(peak / SquaredCornerDistance(image.size()));
  const float centre_u = 0.5f * static_cast<float>(image.cols - 1);
  const float centre_v = 0.5f * static_cast<float>(image.rows - 1);
  const auto variance_of_row = [&](int v) {
    const float y = static_cast<float>(v) - centre_v;
    return RowVariance{.a = b * y * y, .b = b, .centre = centre_u};
  };
  cv::Mat1f along_rows(image.size());
  const int last = image.cols - 1;
  for (int v = 0; v < image.rows; ++v) {
    const float* in = image[v];
    float* out = along_rows[v];
    const RowVariance variance = variance_of_row(v);
    Spread(in - 1, in, in + 1, out, 1, last, variance);
    if (last == 0) {
      out[0] = in[0];
      continue;
    }
    const float half = 0.5f * (variance.a + b * centre_u * centre_u);
    out[0] = in[0] + half * (in[1] - in[0]);
    out[last] = in[last] + half * (in[last - 1] - in[last]);
  }
  for (int v = 0; v < image.rows; ++v) {
    const float* before = along_rows[std::max(v - 1, 0)];
    const float* after = along_rows[std::min(v + 1, image.rows - 1)];
    Spread(before, along_rows[v], after, image[v], 0, image.cols, variance_of_row(v));
  }
}

}  // namespace

double IlluminancePerLuminance(const LensOptions& lens) {
  return std::numbers::pi * lens.transmission / (4.0 * lens.f_number * lens.f_number);
}

cv::Mat1f RelativeIllumination(const RayGrid& rays, const LensOptions& lens) {
  cv::Mat1f relative(rays.height_px(), rays.width_px());
  const auto loss =
      static_cast<float>((1.0 - lens.corner_illumination) / SquaredCornerDistance(relative.size()));
  const cv::Point2f centre(0.5f * static_cast<float>(relative.cols - 1),
                           0.5f * static_cast<float>(relative.rows - 1));
  for (int v = 0; v < relative.rows; ++v) {
    for (int u = 0; u < relative.cols; ++u) {
      const Eigen::Vector2f n = 0.25f * (rays.Corner(u, v) + rays.Corner(u + 1, v) +
                                         rays.Corner(u, v + 1) + rays.Corner(u + 1, v + 1));
      const float inverse_cos2 = 1.0f + n.squaredNorm();
      const cv::Point2f offset = cv::Point2f(static_cast<float>(u), static_cast<float>(v)) - centre;
      relative(v, u) = (1.0f - loss * offset.dot(offset)) / (inverse_cos2 * inverse_cos2);
    }
  }
  return relative;
}

cv::Mat1f Gather(const QuarterImages& quarters, const PointSpread& spread) {
  FENESTRA_CHECK(spread.corner_sigma_px >= spread.centre_sigma_px,
                 "an image is blurred least in its centre");
  cv::Mat1f blurred = GatherQuarters(quarters, TapsOf(spread.centre_sigma_px));
  const double rest = spread.corner_sigma_px * spread.corner_sigma_px -
                      spread.centre_sigma_px * spread.centre_sigma_px;
  // A three-tap kernel of variance 1/4 is close to a Gaussian; more of it takes several.
  constexpr double kLargestVariance = 0.25;
  const int passes = static_cast<int>(std::ceil(rest / kLargestVariance));
  for (int i = 0; i < passes; ++i) SpreadOnce(blurred, rest / passes);
  return blurred;
}

}  // namespace fenestra
