#include "vision/calibration/corner_refinement.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

using Eigen::Vector2d;

constexpr int kUnknowns = 9;
using Parameters = Eigen::Matrix<double, kUnknowns, 1>;
using Information = Eigen::Matrix<double, kUnknowns, kUnknowns>;

// Indices of the unknowns.
enum : int { kX, kY, kAngle1, kAngle2, kBlur, kLevel, kContrast, kShadeX, kShadeY };

constexpr double kLeastBlur_px = 0.1;
constexpr double kLeastContrast_dn = 3.0;
constexpr double kPixelVariance = 1.0 / 12.0;  // Variance of a unit square in any direction.

// The antiderivative of the edge profile erf(x/(√2 s)), and its derivatives.
struct ProfileIntegral {
  ProfileIntegral(double x, double s) {
    const double bell = std::sqrt(2.0 / std::numbers::pi) * std::exp(-0.5 * x * x / (s * s));
    by_x = std::erf(x / (s * std::numbers::sqrt2));
    value = x * by_x + s * bell;
    by_s = bell;
  }
  double value;
  double by_x;
  double by_s;
};

// One edge as pixels see it: blurred, then averaged over the pixel's square. Across the edge, the
// square acts as two boxes of widths |cos| and |sin| of the normal's angle. The wide box is
// integrated exactly; the narrow one adds its variance to the blur.
struct Edge {
  Edge(double angle, double blur_px, const Vector2d& offset)
      : normal(std::cos(angle), std::sin(angle)) {
    const double wide = std::max(std::abs(normal.x()), std::abs(normal.y()));
    const double narrow = std::min(std::abs(normal.x()), std::abs(normal.y()));
    const double blur = std::sqrt(blur_px * blur_px + narrow * narrow * kPixelVariance);
    const double d = normal.dot(offset);
    const ProfileIntegral far(d + 0.5 * wide, blur);
    const ProfileIntegral near(d - 0.5 * wide, blur);
    value = (far.value - near.value) / wide;
    by_offset = (far.by_x - near.by_x) / wide;
    by_blur = (far.by_s - near.by_s) / wide * blur_px / blur;
    by_angle = by_offset * (normal.x() * offset.y() - normal.y() * offset.x());
    distance = d / std::sqrt(blur_px * blur_px + kPixelVariance);
    density = std::sqrt(2.0 / std::numbers::pi) * std::exp(-0.5 * distance * distance);
  }
  Vector2d normal;
  double value;  // From -1 to 1.
  double by_offset;
  double by_angle;
  double by_blur;
  double distance;  // In units of the total blur.
  double density;
};

// Correction for edges that are not perpendicular, ρ = n₁·n₂ ≠ 0. Since blur acts on both edges
// jointly, the tetrachoric series Σ ρᵏ/k! He_{k-1} He_{k-1} φ φ is added to the corner's profile
// erf erf.
double Obliqueness(const Edge& first, const Edge& second) {
  const double rho = first.normal.dot(second.normal);
  const double x = first.distance;
  const double y = second.distance;
  const double series =
      rho * (1.0 + rho * (0.5 * x * y + rho / 6.0 * (x * x - 1.0) * (y * y - 1.0)));
  return first.density * second.density * series;
}

struct Normals {
  Information matrix = Information::Zero();
  Parameters vector = Parameters::Zero();
};

// Normal equations of the weighted least squares at p.
std::optional<Normals> Linearise(const cv::Mat1b& image, const Parameters& p, double radius_px) {
  const int left = static_cast<int>(std::ceil(p[kX] - radius_px));
  const int right = static_cast<int>(std::floor(p[kX] + radius_px));
  const int top = static_cast<int>(std::ceil(p[kY] - radius_px));
  const int bottom = static_cast<int>(std::floor(p[kY] + radius_px));
  if (left < 0 || top < 0 || right >= image.cols || bottom >= image.rows) return std::nullopt;
  Normals normals;
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const Vector2d offset(u - p[kX], v - p[kY]);
      const double weight = 1.0 - offset.squaredNorm() / (radius_px * radius_px);
      if (weight <= 0.0) continue;
      const Edge first(p[kAngle1], p[kBlur], offset);
      const Edge second(p[kAngle2], p[kBlur], offset);
      const double b = p[kContrast];
      const Vector2d shade(p[kShadeX], p[kShadeY]);
      const Vector2d by_corner = -shade - b * (first.by_offset * second.value * first.normal +
                                               first.value * second.by_offset * second.normal);
      Parameters row;
      row << by_corner, b * first.by_angle * second.value, b * first.value * second.by_angle,
          b * (first.by_blur * second.value + first.value * second.by_blur), 1.0,
          first.value * second.value, offset;
      const double model = p[kLevel] + shade.dot(offset) +
                           b * (first.value * second.value + Obliqueness(first, second));
      normals.matrix.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      normals.vector += weight * (image(v, u) - model) * row;
    }
  }
  return normals;
}

double NormalAngle(const Vector2d& direction) {
  return std::atan2(direction.x(), -direction.y());
}

// Best level and contrast with all other unknowns as guessed, which is a linear problem.
void FitGrey(const cv::Mat1b& image, double radius_px, Parameters& p) {
  p[kContrast] = 0.0;
  const auto normals = Linearise(image, p, radius_px);
  if (!normals) return;
  const Information full = normals->matrix.selfadjointView<Eigen::Lower>();
  const Eigen::Vector2d grey =
      full.block<2, 2>(kLevel, kLevel).ldlt().solve(normals->vector.segment<2>(kLevel));
  p.segment<2>(kLevel) += grey;
}

}  // namespace

std::optional<Vector2d> RefineCorner(const cv::Mat1b& image, const CornerGuess& guess) {
  constexpr int kMostSteps = 30;
  constexpr double kSettled_px = 1e-4;
  Parameters p = Parameters::Zero();
  p.head<2>() = guess.pixel;
  p[kAngle1] = NormalAngle(guess.along_row);
  p[kAngle2] = NormalAngle(guess.along_column);
  p[kBlur] = 0.6;
  FitGrey(image, guess.radius_px, p);
  for (int i = 0; i < kMostSteps; ++i) {
    const auto normals = Linearise(image, p, guess.radius_px);
    if (!normals || std::abs(p[kContrast]) < kLeastContrast_dn) return std::nullopt;
    const Information full = normals->matrix.selfadjointView<Eigen::Lower>();
    Parameters step = full.ldlt().solve(normals->vector);
    if (!step.allFinite()) return std::nullopt;
    // The corner is known to a pixel, so longer steps are caused by a poor start.
    const double length = step.head<2>().norm();
    if (length > 1.0) step /= length;
    p += step;
    p[kBlur] = std::clamp(p[kBlur], kLeastBlur_px, guess.radius_px);
    if ((p.head<2>() - guess.pixel).norm() > guess.radius_px) return std::nullopt;
    if (length < kSettled_px) return p.head<2>();
  }
  return std::nullopt;
}

}  // namespace fenestra
