#include "sim/camera/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/system/check.h"
#include "core/system/wide.h"

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
  // At half-pixel steps the weights of a narrow Gaussian have a slightly different variance: find
  // the Gaussian whose weights have the wanted variance.
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

// Number of floats in a row.
int WidthOf(const cv::Mat& image) {
  return image.cols * image.channels();
}

// The column of quarters on one side of the pixels' centres, of one row of pixels: weighted over
// the rows around it, and replicated by `reach` pixels at both ends.
void GatherColumn(const cv::Mat& upper, const cv::Mat& lower, const HalfTaps& taps, int row,
                  std::vector<float>& gathered) {
  std::fill(gathered.begin(), gathered.end(), 0.0f);
  float* inside = gathered.data() + taps.reach * upper.channels();
  for (int k = -taps.reach; k <= taps.reach; ++k) {
    const auto tap = static_cast<size_t>(k + taps.reach);
    const int from = row + k;
    // Beyond the border both halves repeat the outermost one.
    const cv::Mat& above = from >= upper.rows ? lower : upper;
    const cv::Mat& below = from < 0 ? upper : lower;
    const int inner = std::clamp(from, 0, upper.rows - 1);
    AddScaled(above.ptr<float>(inner), taps.before[tap], inside, WidthOf(upper));
    AddScaled(below.ptr<float>(inner), taps.after[tap], inside, WidthOf(upper));
  }
}

// Repeats the pixel `first` before it and `last` behind it, `reach` times.
void Replicate(std::vector<float>& row, int reach, int channels, const float* first,
               const float* last) {
  const auto ends = static_cast<std::ptrdiff_t>(reach * channels);
  for (std::ptrdiff_t i = 0; i < ends; ++i) {
    row[static_cast<size_t>(i)] = first[i % channels];
    *(row.end() - ends + i) = last[i % channels];
  }
}

// One kernel over all quarters around each pixel.
cv::Mat GatherQuarters(const QuarterImages& quarters, const HalfTaps& taps) {
  const auto& [upper_left, upper_right, lower_left, lower_right] = quarters;
  cv::Mat pixels = cv::Mat::zeros(upper_left.size(), upper_left.type());
  const int channels = pixels.channels();
  const int width = WidthOf(pixels);
  std::vector<float> left(static_cast<size_t>(width + 2 * taps.reach * channels));
  std::vector<float> right(left.size());
  std::vector<float> first(static_cast<size_t>(channels));
  std::vector<float> last(first.size());
  for (int row = 0; row < pixels.rows; ++row) {
    GatherColumn(upper_left, lower_left, taps, row, left);
    GatherColumn(upper_right, lower_right, taps, row, right);
    std::copy_n(left.begin() + taps.reach * channels, channels, first.begin());
    std::copy_n(right.end() - (taps.reach + 1) * channels, channels, last.begin());
    Replicate(left, taps.reach, channels, first.data(), last.data());
    Replicate(right, taps.reach, channels, first.data(), last.data());
    for (int k = 0; k <= 2 * taps.reach; ++k) {
      const auto tap = static_cast<size_t>(k);
      AddScaled(left.data() + k * channels, taps.before[tap], pixels.ptr<float>(row), width);
      AddScaled(right.data() + k * channels, taps.after[tap], pixels.ptr<float>(row), width);
    }
  }
  return pixels;
}

// ρ² = 1 at the outer corners of the corner pixels.
double SquaredCornerDistance(cv::Size size) {
  return 0.25 * (static_cast<double>(size.width) * size.width +
                 static_cast<double>(size.height) * size.height);
}

// Half the variance of a three-tap kernel at each float of a row, b ρ² of the whole image's.
std::vector<float> HalfVariances(const cv::Mat& image, float b, int row) {
  std::vector<float> half(static_cast<size_t>(WidthOf(image)));
  const float centre_u = 0.5f * static_cast<float>(image.cols - 1);
  const float y = static_cast<float>(row) - 0.5f * static_cast<float>(image.rows - 1);
  const float a = b * y * y;
  size_t i = 0;
  for (int u = 0; u < image.cols; ++u) {
    const float x = static_cast<float>(u) - centre_u;
    for (int c = 0; c < image.channels(); ++c) half[i++] = 0.5f * (a + b * x * x);
  }
  return half;
}

// out = in + variance/2 (before - 2 in + after).
FENESTRA_WIDE void Spread(const float* before, const float* in, const float* after, float* out,
                          const float* half, int count) {
  for (int i = 0; i < count; ++i) {
    out[i] = in[i] + half[i] * (before[i] - 2.0f * in[i] + after[i]);
  }
}

// One three-tap kernel along the rows and one along the columns, of variance peak ρ² each.
void SpreadOnce(cv::Mat& image, double peak) {
  const auto b = static_cast<float>(peak / SquaredCornerDistance(image.size()));
  cv::Mat along_rows(image.size(), image.type());
  const int channels = image.channels();
  const int last = WidthOf(image) - channels;
  for (int v = 0; v < image.rows; ++v) {
    const float* in = image.ptr<float>(v);
    float* out = along_rows.ptr<float>(v);
    const std::vector<float> half = HalfVariances(image, b, v);
    Spread(in, in + channels, in + 2 * channels, out + channels, half.data() + channels,
           last - channels);
    for (int c = 0; c < channels; ++c) {
      const int end = last + c;
      out[c] = in[c];
      out[end] = in[end];
      if (last == 0) continue;
      out[c] += half[static_cast<size_t>(c)] * (in[c + channels] - in[c]);
      out[end] += half[static_cast<size_t>(end)] * (in[end - channels] - in[end]);
    }
  }
  for (int v = 0; v < image.rows; ++v) {
    Spread(along_rows.ptr<float>(std::max(v - 1, 0)), along_rows.ptr<float>(v),
           along_rows.ptr<float>(std::min(v + 1, image.rows - 1)), image.ptr<float>(v),
           HalfVariances(image, b, v).data(), WidthOf(image));
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

cv::Mat WithVeilingGlare(const cv::Mat& image, double glare) {
  FENESTRA_CHECK(glare >= 0.0 && glare <= 1.0, "veiling glare is a share of the light");
  cv::Mat veiled;
  image.convertTo(veiled, -1, 1.0 - glare);
  veiled += cv::mean(image) * glare;
  return veiled;
}

cv::Mat Gather(const QuarterImages& quarters, const PointSpread& spread) {
  FENESTRA_CHECK(spread.corner_sigma_px >= spread.centre_sigma_px,
                 "an image is blurred least in its centre");
  cv::Mat blurred = GatherQuarters(quarters, TapsOf(spread.centre_sigma_px));
  const double rest = spread.corner_sigma_px * spread.corner_sigma_px -
                      spread.centre_sigma_px * spread.centre_sigma_px;
  // A three-tap kernel of variance 1/4 is close to a Gaussian; larger variances take several.
  constexpr double kLargestVariance = 0.25;
  const int passes = static_cast<int>(std::ceil(rest / kLargestVariance));
  for (int i = 0; i < passes; ++i) SpreadOnce(blurred, rest / passes);
  return blurred;
}

}  // namespace fenestra
