#include "experiments/emva/evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/io/faults.h"

namespace fenestra::emva {
namespace {

constexpr double kQuantisationVariance = 1.0 / 12.0;  // [DN²]
constexpr double kLeastDarkVariance = 0.24;           // [DN²]; section 6.6
constexpr size_t kFewestExposures = 3;

struct MeanAndVariance {
  double mean;
  double variance;
};

// The temporal variance by two images: half that of their difference, whatever pattern they share.
MeanAndVariance Temporal(const ImageSet& set, const ImageReader& images) {
  cv::Mat1d first;
  cv::Mat1d second;
  images(set, 0).convertTo(first, CV_64F);
  images(set, 1).convertTo(second, CV_64F);
  const double mean_first = cv::mean(first)[0];
  const double mean_second = cv::mean(second)[0];
  const double mean_square = cv::norm(first, second, cv::NORM_L2SQR) / first.total();
  const double difference = mean_first - mean_second;
  return {0.5 * (mean_first + mean_second), 0.5 * (mean_square - difference * difference)};
}

// Squares of a NonUniformity [DN²], and the mean.
struct SpatialVariances {
  double mean;
  double total;
  double row;
  double column;
  double pixel;
};

double Variance(const cv::Mat1d& values, double mean) {
  return cv::norm(values - mean, cv::NORM_L2SQR) / static_cast<double>(values.total());
}

SpatialVariances Spatial(const ImageSet& set, const ImageReader& images) {
  cv::Mat1d sum;
  cv::Mat1d squares;
  for (size_t i = 0; i < set.files.size(); ++i) {
    cv::Mat1d image;
    images(set, i).convertTo(image, CV_64F);
    if (sum.empty()) {
      sum = cv::Mat1d::zeros(image.size());
      squares = cv::Mat1d::zeros(image.size());
    }
    sum += image;
    squares += image.mul(image);
  }
  const double L = static_cast<double>(set.files.size());
  const cv::Mat1d average = sum / L;
  const double mean = cv::mean(average)[0];
  const double temporal = cv::mean(squares - average.mul(sum))[0] / (L - 1.0);
  const double M = average.rows;
  const double N = average.cols;
  cv::Mat1d of_columns;
  cv::Mat1d of_rows;
  cv::reduce(average, of_columns, 0, cv::REDUCE_AVG);
  cv::reduce(average, of_rows, 1, cv::REDUCE_AVG);
  // Release 4.0, section 8.2: means of columns and rows hold a share of the pixels' variance.
  const double total = Variance(average, mean) * (M * N) / (M * N - 1.0) - temporal / L;
  const double columns = Variance(of_columns, mean) - temporal / (L * M);
  const double rows = Variance(of_rows, mean) - temporal / (L * N);
  const double rest = M * N - M - N;
  return {.mean = mean,
          .total = total,
          .row = ((M * N - N) * rows - M * (total - columns)) / rest,
          .column = ((M * N - M) * columns - N * (total - rows)) / rest,
          .pixel = M * N * (total - columns - rows) / rest};
}

double Root(double variance) {
  return std::sqrt(std::max(variance, 0.0));
}

std::vector<TransferPoint> TransferOf(const Series& series, const ImageReader& images) {
  std::map<double, MeanAndVariance> dark;
  for (const ImageSet& set : series.sets) {
    if (!set.is_spatial() && set.is_dark()) dark[set.exposure_s] = Temporal(set, images);
  }
  std::vector<TransferPoint> points;
  Faults faults("series");
  for (const ImageSet& set : series.sets) {
    if (set.is_spatial() || set.is_dark()) continue;
    const auto beside = dark.find(set.exposure_s);
    if (beside == dark.end()) {
      faults.Add(fmt::format("the bright pair at {:g} ms has no dark pair beside it",
                             1e3 * set.exposure_s));
      continue;
    }
    const MeanAndVariance bright = Temporal(set, images);
    points.push_back({.exposure_s = set.exposure_s,
                      .photons = set.photons,
                      .mean = bright.mean,
                      .variance = bright.variance,
                      .dark_mean = beside->second.mean,
                      .dark_variance = beside->second.variance});
  }
  faults.Require(faults.count() > 0 || points.size() >= kFewestExposures,
                 fmt::format("{} exposures with a bright and a dark pair are fewer than {}",
                             points.size(), kFewestExposures));
  faults.ThrowIfAny();
  std::sort(points.begin(), points.end(),
            [](const TransferPoint& a, const TransferPoint& b) { return a.photons < b.photons; });
  return points;
}

// The largest variance, met on the way down from full light: noise before it may be higher locally.
size_t SaturationOf(const std::vector<TransferPoint>& points) {
  size_t best = points.size() - 1;
  for (size_t i = points.size(); i-- > 0;) {
    const double before = points[i > 0 ? i - 1 : i].variance;
    if (points[i].variance >= points[best].variance || before >= points[best].variance) {
      if (points[i].variance >= points[best].variance) best = i;
    } else {
      break;
    }
  }
  return best;
}

struct Line {
  double slope;
  double offset;
};

// Least squares of y over x.
Line FitLine(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {slope, (sy - slope * sx) / n};
}

// Release 4.0, section 6.7: a line through 5 to 95 % of saturation, weighted with 1/signal²; the
// relative deviations from it.
void MeasureLinearity(Results& r) {
  const double full = r.points[r.saturation_point].signal();
  double w = 0.0, wx = 0.0, wy = 0.0, wxx = 0.0, wxy = 0.0;
  const auto counts = [&](const TransferPoint& p) {
    return p.signal() >= 0.05 * full && p.signal() <= 0.95 * full;
  };
  for (const TransferPoint& p : r.points) {
    if (!counts(p)) continue;
    const double weight = 1.0 / (p.signal() * p.signal());
    w += weight;
    wx += weight * p.photons;
    wy += weight * p.signal();
    wxx += weight * p.photons * p.photons;
    wxy += weight * p.photons * p.signal();
  }
  const double slope = (w * wxy - wx * wy) / (w * wxx - wx * wx);
  const double offset = (wy - slope * wx) / w;
  r.linearity_error_min = std::numeric_limits<double>::infinity();
  r.linearity_error_max = -std::numeric_limits<double>::infinity();
  for (const TransferPoint& p : r.points) {
    if (!counts(p)) continue;
    const double deviation = p.signal() / (slope * p.photons + offset) - 1.0;
    r.linearity_error_min = std::min(r.linearity_error_min, deviation);
    r.linearity_error_max = std::max(r.linearity_error_max, deviation);
  }
}

// K, R and what follows from the dark pairs.
void MeasureTransfer(Results& r) {
  const double most = 0.7 * r.points[r.saturation_point].signal();
  double signal2 = 0.0, signal_variance = 0.0, photons2 = 0.0, photons_signal = 0.0;
  r.last_fit_point = 0;
  for (size_t i = 0; i < r.points.size(); ++i) {
    const TransferPoint& p = r.points[i];
    if (p.signal() > most) continue;
    r.last_fit_point = i;
    signal2 += p.signal() * p.signal();
    signal_variance += p.signal() * p.light_variance();
    photons2 += p.photons * p.photons;
    photons_signal += p.photons * p.signal();
  }
  r.gain_dn_per_e = signal_variance / signal2;
  r.responsivity = photons_signal / photons2;
  r.quantum_efficiency = r.responsivity / r.gain_dn_per_e;

  std::vector<double> exposure;
  std::vector<double> mean;
  std::vector<double> variance;
  for (const TransferPoint& p : r.points) {
    exposure.push_back(p.exposure_s);
    mean.push_back(p.dark_mean);
    variance.push_back(p.dark_variance);
  }
  const double measured_variance = FitLine(exposure, variance).offset;
  const double dark_variance = std::max(measured_variance, kLeastDarkVariance);
  r.dark_noise_is_floor = measured_variance < kLeastDarkVariance;
  r.dark_noise_e = std::sqrt(dark_variance - kQuantisationVariance) / r.gain_dn_per_e;
  r.dark_current_e_s = FitLine(exposure, mean).slope / r.gain_dn_per_e;
  r.threshold_photons = (std::sqrt(dark_variance) / r.gain_dn_per_e + 0.5) / r.quantum_efficiency;
}

void MeasureUniformity(const Series& series, const ImageReader& images, Results& r) {
  const ImageSet* bright = nullptr;
  const ImageSet* dark = nullptr;
  for (const ImageSet& set : series.sets) {
    if (set.is_spatial()) (set.is_dark() ? dark : bright) = &set;
  }
  if (bright == nullptr || dark == nullptr) {
    throw InputError("series",
                     "a stack of bright frames at 50 % of saturation and one of dark "
                     "frames are needed for the spatial figures");
  }
  const SpatialVariances lit = Spatial(*bright, images);
  const SpatialVariances unlit = Spatial(*dark, images);
  const double K = r.gain_dn_per_e;
  r.dsnu_e = {.total = Root(unlit.total) / K,
              .row = Root(unlit.row) / K,
              .column = Root(unlit.column) / K,
              .pixel = Root(unlit.pixel) / K};
  const double signal = lit.mean - unlit.mean;
  r.prnu = {.total = Root(lit.total - unlit.total) / signal,
            .row = Root(lit.row - unlit.row) / signal,
            .column = Root(lit.column - unlit.column) / signal,
            .pixel = Root(lit.pixel - unlit.pixel) / signal};
}

}  // namespace

Results Evaluate(const Series& series, const ImageReader& images) {
  Results r{};
  r.points = TransferOf(series, images);
  r.saturation_point = SaturationOf(r.points);
  if (r.saturation_point + 1 == r.points.size()) {
    throw InputError("series",
                     "the light does not reach saturation: the temporal variance still "
                     "grows at the longest exposure");
  }
  MeasureTransfer(r);
  if (!(r.gain_dn_per_e > 0.0)) {
    throw InputError("series",
                     "the temporal variance does not grow with the signal: there is no "
                     "shot noise to measure the gain by");
  }
  r.saturation_photons = r.points[r.saturation_point].photons;
  r.saturation_e = r.quantum_efficiency * r.saturation_photons;
  r.largest_snr = std::sqrt(r.saturation_e);
  r.dynamic_range = r.saturation_photons / r.threshold_photons;
  MeasureLinearity(r);
  MeasureUniformity(series, images, r);
  return r;
}

}  // namespace fenestra::emva
