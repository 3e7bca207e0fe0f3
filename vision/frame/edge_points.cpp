#include "vision/frame/edge_points.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/frame/blurred_step.h"

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPlace_px = 8.0;
constexpr int kFewestPlaces = 3;
constexpr int kMostPlaces = 40;
constexpr int kIterations = 6;
constexpr double kLeastVariance = 1.0 / 12.0;  // Of a grey value that is rounded.
constexpr double kLeastSigma_px = 0.001;       // What the model of blur and lens is worth.
constexpr double kSmallestBlur_px = 0.25;
constexpr double kLargestBlur_px = 1.5;
// Residuals of more than this many times the side's median variance are of something else.
constexpr double kMostExcess = 9.0;
constexpr double kOwnExcess = 2.0;

struct PlaceOnEdge {
  double share;
  double half_length_px;
  Vector2d pixel;
  Vector2d along;
  Vector2d normal;
};

struct Pixel {
  double s_px;
  double grey_dn;
};

struct PlaceFit {
  PlaceOnEdge place;
  std::vector<Pixel> pixels;
  double base_dn;
  double rise_dn;
  double s0_px;
  double s0_variance;  // For weights as they are.
  double mean_square;  // Weighted, per degree of freedom.
};

std::vector<PlaceOnEdge> Places(const CameraView& view, const FrameRectangle& frame,
                                const SideRequest& request) {
  const auto pixel_at = [&](double share) {
    return view.camera.Project(view.X_CL * frame.PointOn(request.side, request.border, share));
  };
  std::vector<PlaceOnEdge> places;
  const auto first = pixel_at(0.0);
  const auto last = pixel_at(1.0);
  if (!first || !last) return places;
  const double length_px = (*last - *first).norm();
  const double margin = (request.reach_px + 1.0) / std::max(1.0, length_px);
  const double usable = 1.0 - 2.0 * margin;
  if (usable * length_px < kFewestPlaces * 2.0) return places;
  const int count =
      std::clamp(static_cast<int>(usable * length_px / kPlace_px), kFewestPlaces, kMostPlaces);
  const double step = usable / count;
  for (int i = 0; i < count; ++i) {
    const double share = margin + (i + 0.5) * step;
    const auto from = pixel_at(share - 0.5 * step);
    const auto to = pixel_at(share + 0.5 * step);
    const auto middle = pixel_at(share);
    if (!from || !to || !middle) continue;
    const Vector2d along = (*to - *from).normalized();
    places.push_back({.share = share,
                      .half_length_px = 0.5 * (*to - *from).norm(),
                      .pixel = *middle,
                      .along = along,
                      .normal = {along.y(), -along.x()}});
  }
  return places;
}

// Empty if one of them is outside the image.
std::vector<Pixel> Gather(const cv::Mat1b& image, const PlaceOnEdge& place, double reach_px) {
  const Vector2d extent =
      reach_px * place.normal.cwiseAbs() + place.half_length_px * place.along.cwiseAbs();
  const int u_first = static_cast<int>(std::ceil(place.pixel.x() - extent.x()));
  const int u_last = static_cast<int>(std::floor(place.pixel.x() + extent.x()));
  const int v_first = static_cast<int>(std::ceil(place.pixel.y() - extent.y()));
  const int v_last = static_cast<int>(std::floor(place.pixel.y() + extent.y()));
  std::vector<Pixel> pixels;
  if (u_first < 0 || v_first < 0 || u_last >= image.cols || v_last >= image.rows) return pixels;
  pixels.reserve(static_cast<size_t>(u_last - u_first + 1) * (v_last - v_first + 1));
  for (int v = v_first; v <= v_last; ++v) {
    const uchar* row = image.ptr(v);
    for (int u = u_first; u <= u_last; ++u) {
      const Vector2d offset = Vector2d(u, v) - place.pixel;
      const double s = offset.dot(place.normal);
      if (std::abs(s) > reach_px || std::abs(offset.dot(place.along)) > place.half_length_px) {
        continue;
      }
      pixels.push_back({s, static_cast<double>(row[u])});
    }
  }
  return pixels;
}

// Weight of a pixel whose share of the outer grey value is p.
double WeightAt(double p, const EdgeTuning& tuning, Brighter brighter) {
  const double bright_share = brighter == Brighter::kOutside ? p : 1.0 - p;
  return 1.0 /
         (tuning.dark_variance + bright_share * (tuning.bright_variance - tuning.dark_variance));
}

bool SolveLevels(const BlurredStep& step, PlaceFit& fit) {
  double n = 0.0, p1 = 0.0, p2 = 0.0, y = 0.0, py = 0.0;
  for (const Pixel& pixel : fit.pixels) {
    const double p = step.At(pixel.s_px - fit.s0_px).p;
    n += 1.0;
    p1 += p;
    p2 += p * p;
    y += pixel.grey_dn;
    py += p * pixel.grey_dn;
  }
  const double determinant = n * p2 - p1 * p1;
  if (!(determinant > 0.5)) return false;
  fit.base_dn = (p2 * y - p1 * py) / determinant;
  fit.rise_dn = (n * py - p1 * y) / determinant;
  return true;
}

std::optional<PlaceFit> FitPlace(const CameraView& view, const PlaceOnEdge& place,
                                 const SideRequest& request, const BlurredStep& step,
                                 const EdgeTuning& tuning) {
  PlaceFit fit{.place = place,
               .pixels = Gather(view.image, place, request.reach_px),
               .base_dn = 0.0,
               .rise_dn = 0.0,
               .s0_px = 0.0,
               .s0_variance = 0.0,
               .mean_square = 0.0};
  if (fit.pixels.size() < 8 || !SolveLevels(step, fit)) return std::nullopt;
  const double sign = request.brighter == Brighter::kOutside ? 1.0 : -1.0;
  if (sign * fit.rise_dn < 0.5 * request.min_contrast_dn) return std::nullopt;
  for (int i = 0; i < kIterations; ++i) {
    Matrix3d normal = Matrix3d::Zero();
    Vector3d gradient = Vector3d::Zero();
    double square = 0.0;
    for (const Pixel& pixel : fit.pixels) {
      const BlurredStep::Value at = step.At(pixel.s_px - fit.s0_px);
      const double residual = pixel.grey_dn - fit.base_dn - fit.rise_dn * at.p;
      const Vector3d j(1.0, at.p, -fit.rise_dn * at.by_s);
      const double weight = WeightAt(at.p, tuning, request.brighter);
      normal.noalias() += weight * j * j.transpose();
      gradient += weight * residual * j;
      square += weight * residual * residual;
    }
    const double determinant = normal.determinant();
    if (!(determinant > 0.0)) return std::nullopt;
    const Matrix3d inverse = normal.inverse();
    Vector3d change = inverse * gradient;
    const double largest_px = 0.7;
    if (std::abs(change[2]) > largest_px) change *= largest_px / std::abs(change[2]);
    fit.base_dn += change[0];
    fit.rise_dn += change[1];
    fit.s0_px += change[2];
    fit.s0_variance = inverse(2, 2);
    fit.mean_square = square / static_cast<double>(fit.pixels.size() - 3);
    if (std::abs(fit.s0_px) > 0.7 * request.reach_px) return std::nullopt;
    if (sign * fit.rise_dn < request.min_contrast_dn) return std::nullopt;
    if (std::abs(change[2]) < 1e-3) break;
  }
  return fit;
}

double MedianSquare(const std::vector<PlaceFit>& fits) {
  std::vector<double> squares;
  for (const PlaceFit& fit : fits) squares.push_back(fit.mean_square);
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return *middle;
}

EdgeTuning Learn(const std::vector<PlaceFit>& fits, const BlurredStep& step,
                 const SideRequest& request, const EdgeTuning& tuning) {
  std::array<double, 2> squares = {};  // Inside, outside.
  std::array<double, 2> counts = {};
  double product = 0.0;
  double norm = 0.0;
  for (const PlaceFit& fit : fits) {
    for (const Pixel& pixel : fit.pixels) {
      const BlurredStep::Value at = step.At(pixel.s_px - fit.s0_px);
      const double residual = pixel.grey_dn - fit.base_dn - fit.rise_dn * at.p;
      const double by_sigma = fit.rise_dn * at.by_sigma;
      const double weight = WeightAt(at.p, tuning, request.brighter);
      product += weight * residual * by_sigma;
      norm += weight * by_sigma * by_sigma;
      if (at.p > 0.05 && at.p < 0.95) continue;
      const size_t i = at.p > 0.5 ? 1 : 0;
      squares[i] += residual * residual;
      counts[i] += 1.0;
    }
  }
  EdgeTuning learnt = tuning;
  if (norm > 0.0) {
    learnt.blur_px = std::clamp(tuning.blur_px + std::clamp(product / norm, -0.2, 0.2),
                                kSmallestBlur_px, kLargestBlur_px);
  }
  if (std::min(counts[0], counts[1]) >= 20.0) {
    const double inside = std::max(kLeastVariance, squares[0] / counts[0]);
    const double outside = std::max(kLeastVariance, squares[1] / counts[1]);
    const bool bright_outside = request.brighter == Brighter::kOutside;
    learnt.dark_variance = bright_outside ? inside : outside;
    learnt.bright_variance = bright_outside ? outside : inside;
  }
  return learnt;
}

}  // namespace

SideEdges MeasureSide(const CameraView& view, const FrameRectangle& frame,
                      const SideRequest& request, const EdgeTuning& tuning) {
  SideEdges edges;
  edges.tuning = tuning;
  const std::vector<PlaceOnEdge> places = Places(view, frame, request);
  edges.places = static_cast<int>(places.size());
  if (places.empty()) return edges;
  const BlurredStep step(tuning.blur_px, places[places.size() / 2].normal);
  std::vector<PlaceFit> fits;
  for (const PlaceOnEdge& place : places) {
    if (auto fit = FitPlace(view, place, request, step, tuning)) fits.push_back(std::move(*fit));
  }
  if (fits.empty()) return edges;
  const double median = MedianSquare(fits);
  std::erase_if(fits, [&](const PlaceFit& fit) { return fit.mean_square > kMostExcess * median; });
  for (const PlaceFit& fit : fits) {
    const double scale = fit.mean_square > kOwnExcess * median ? fit.mean_square : median;
    edges.points.push_back(
        {.side = request.side,
         .border = request.border,
         .share = fit.place.share,
         .normal = fit.place.normal,
         .pixel = fit.place.pixel + fit.s0_px * fit.place.normal,
         .sigma_px = std::sqrt(scale * fit.s0_variance + kLeastSigma_px * kLeastSigma_px)});
  }
  edges.tuning = Learn(fits, step, request, tuning);
  return edges;
}

}  // namespace fenestra
