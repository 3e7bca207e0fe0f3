#include "sim/camera/point_spread.h"

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

// Variance of the point spread at each pixel of a row beyond that in the centre, σ² - σ₀².
void RestOfRow(const PointSpread& spread, cv::Size size, int row, float* rest) {
  const auto b = static_cast<float>((spread.corner_sigma_px * spread.corner_sigma_px -
                                     spread.centre_sigma_px * spread.centre_sigma_px) /
                                    SquaredHalfDiagonal(size));
  const float centre_u = 0.5f * static_cast<float>(size.width - 1);
  const float y = static_cast<float>(row) - 0.5f * static_cast<float>(size.height - 1);
  for (int u = 0; u < size.width; ++u) {
    const float x = static_cast<float>(u) - centre_u;
    rest[u] = b * (x * x + y * y);
  }
  if (spread.confusion_px.empty()) return;
  const float* c = spread.confusion_px[row];
  for (int u = 0; u < size.width; ++u) rest[u] += c[u] * c[u] / 16.0f;
}

// Half the variance of one of several equal kernels at each float of a row.
std::vector<float> HalfVariances(const cv::Mat1f& rest, int passes, int channels, int row) {
  std::vector<float> half(static_cast<size_t>(rest.cols * channels));
  const float share = 0.5f / static_cast<float>(passes);
  size_t i = 0;
  for (int u = 0; u < rest.cols; ++u) {
    for (int c = 0; c < channels; ++c) half[i++] = share * rest(row, u);
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

// One three-tap kernel along the rows and one along the columns, one of several equal passes.
void SpreadOnce(cv::Mat& image, const cv::Mat1f& rest, int passes) {
  cv::Mat along_rows(image.size(), image.type());
  const int channels = image.channels();
  const int last = WidthOf(image) - channels;
  for (int v = 0; v < image.rows; ++v) {
    const float* in = image.ptr<float>(v);
    float* out = along_rows.ptr<float>(v);
    const std::vector<float> half = HalfVariances(rest, passes, channels, v);
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
           HalfVariances(rest, passes, channels, v).data(), WidthOf(image));
  }
}

FENESTRA_WIDE void LaplacianOfRow(const float* above, const float* left, const float* in,
                                  const float* right, const float* below, float* out, int count) {
  for (int i = 0; i < count; ++i) {
    out[i] = above[i] + left[i] + right[i] + below[i] - 4.0f * in[i];
  }
}

// out -= wx ∂x L + wy ∂y L, down to 0.
FENESTRA_WIDE void SubtractSlope(const float* above, const float* left, const float* right,
                                 const float* below, const float* wx, const float* wy, float* out,
                                 int count) {
  for (int i = 0; i < count; ++i) {
    const float slope = wx[i] * (right[i] - left[i]) + wy[i] * (below[i] - above[i]);
    out[i] = std::max(0.0f, out[i] - 0.5f * slope);
  }
}

void Skew(cv::Mat& image, const PointSpread& spread) {
  const int channels = image.channels();
  const int inner = WidthOf(image) - 2 * channels;
  if (image.rows < 5 || image.cols < 5) return;
  cv::Mat laplacian = cv::Mat::zeros(image.size(), image.type());
  for (int v = 1; v + 1 < image.rows; ++v) {
    const float* in = image.ptr<float>(v);
    LaplacianOfRow(image.ptr<float>(v - 1) + channels, in, in + channels, in + 2 * channels,
                   image.ptr<float>(v + 1) + channels, laplacian.ptr<float>(v) + channels, inner);
  }
  const double half_diagonal_px = std::sqrt(SquaredHalfDiagonal(image.size()));
  std::vector<float> wx(static_cast<size_t>(WidthOf(image)));
  std::vector<float> wy(wx.size());
  for (int v = 2; v + 2 < image.rows; ++v) {
    size_t i = 0;
    for (int u = 0; u < image.cols; ++u) {
      const Eigen::Vector2d place =
          Eigen::Vector2d(u - 0.5 * (image.cols - 1), v - 0.5 * (image.rows - 1)) /
          half_diagonal_px;
      const Eigen::Vector2d coma = spread.corner_coma_px * (place - spread.coma_centre);
      const Eigen::Vector2d weight = coma.squaredNorm() / 24.0 * coma;
      for (int c = 0; c < channels; ++c, ++i) {
        wx[i] = static_cast<float>(weight.x());
        wy[i] = static_cast<float>(weight.y());
      }
    }
    const int first = 2 * channels;
    const float* in = laplacian.ptr<float>(v);
    SubtractSlope(laplacian.ptr<float>(v - 1) + first, in + channels, in + 3 * channels,
                  laplacian.ptr<float>(v + 1) + first, wx.data() + first, wy.data() + first,
                  image.ptr<float>(v) + first, WidthOf(image) - 2 * first);
  }
}

}  // namespace

double SquaredHalfDiagonal(cv::Size size) {
  return 0.25 * (static_cast<double>(size.width) * size.width +
                 static_cast<double>(size.height) * size.height);
}

double VarianceAt(const PointSpread& spread, cv::Size size, const Eigen::Vector2d& pixel) {
  const int row = std::clamp(static_cast<int>(std::lround(pixel.y())), 0, size.height - 1);
  const int column = std::clamp(static_cast<int>(std::lround(pixel.x())), 0, size.width - 1);
  std::vector<float> rest(static_cast<size_t>(size.width));
  RestOfRow(spread, size, row, rest.data());
  return spread.centre_sigma_px * spread.centre_sigma_px +
         static_cast<double>(rest[static_cast<size_t>(column)]);
}

cv::Mat Gather(const QuarterImages& quarters, const PointSpread& spread) {
  FENESTRA_CHECK(spread.corner_sigma_px >= spread.centre_sigma_px,
                 "an image is blurred least in its centre");
  cv::Mat blurred = GatherQuarters(quarters, TapsOf(spread.centre_sigma_px));
  FENESTRA_CHECK(spread.confusion_px.empty() || spread.confusion_px.size() == blurred.size(),
                 "each pixel has one circle of confusion");
  cv::Mat1f rest(blurred.size());
  for (int v = 0; v < rest.rows; ++v) RestOfRow(spread, rest.size(), v, rest[v]);
  double most = 0.0;
  cv::minMaxLoc(rest, nullptr, &most);
  // A three-tap kernel of variance 1/3 has the kurtosis of a Gaussian; larger variances take
  // several.
  constexpr double kLargestVariance = 1.0 / 3.0;
  const int passes = static_cast<int>(std::ceil(most / kLargestVariance));
  for (int i = 0; i < passes; ++i) SpreadOnce(blurred, rest, passes);
  if (spread.corner_coma_px != 0.0) Skew(blurred, spread);
  return blurred;
}

}  // namespace fenestra
