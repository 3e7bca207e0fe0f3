#include "vision/rgbd/plane/depth_plane.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fenestra {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr uint64_t kTriples = 80;
constexpr size_t kMostTried = 400;
constexpr double kOutlier = 3.5;
constexpr int kRefitsFound = 4;     // Refits that start from three points.
constexpr int kRefitsMeasured = 2;  // Refits that start from a nearly correct plane.
constexpr int kTileRounds = 2;
constexpr double kTileBlocks = 3.5;  // Side of a tile in matching blocks.
constexpr double kFullTile = 0.25;   // Tiles with a smaller share of their points do not count.
// Weight of the scatter that the size of the matching blocks predicts, as a number of tiles.
constexpr double kPredictedTiles = 30.0;
// Least scatter, as a share of the variance that the size of the matching blocks predicts.
constexpr double kLeastScatter = 0.5;

double Residual(const DepthPoint& point, const Vector3d& m) {
  return point.inverse_depth - m.dot(point.ray_D);
}

std::optional<Vector3d> MostPopular(const std::vector<DepthPoint>& points, double sigma,
                                    const RandomStream& triples) {
  const size_t tried = std::min(points.size(), kMostTried);
  const auto at = [&](size_t i) -> const DepthPoint& { return points[i * points.size() / tried]; };
  const double limit = std::pow(kOutlier * sigma, 2);
  std::optional<Vector3d> best;
  double least = limit * static_cast<double>(tried);
  for (uint64_t i = 0; i < kTriples; ++i) {
    Matrix3d rays;
    Vector3d inverse_depths;
    for (int k = 0; k < 3; ++k) {
      const double share = triples.Uniform(3 * i + static_cast<uint64_t>(k));
      const DepthPoint& point = at(static_cast<size_t>(share * static_cast<double>(tried)));
      rays.row(k) = point.ray_D;
      inverse_depths[k] = point.inverse_depth;
    }
    if (std::abs(rays.determinant()) < 1e-6) continue;
    const Vector3d m = rays.inverse() * inverse_depths;
    double cost = 0.0;
    for (size_t k = 0; k < tried && cost < least; ++k) {
      const double r = Residual(at(k), m);
      cost += std::min(limit, r * r);
    }
    if (cost >= least) continue;
    least = cost;
    best = m;
  }
  return best;
}

// Sum and number of the residuals in one tile of the image.
struct Tile {
  double sum = 0.0;
  double count = 0.0;
};

class PlaneFitter {
 public:
  PlaneFitter(const std::vector<DepthPoint>& points, const DepthNoise& noise)
      : points_(points),
        noise_(noise),
        least_sigma_(std::max(0.2 * noise.sigma, noise.step / std::sqrt(12.0))),
        side_px_(std::max(1, static_cast<int>(kTileBlocks * noise.window_px))),
        half_(noise.image.width / (2 * side_px_) + 1, noise.image.height / (2 * side_px_) + 1),
        full_(kTileBlocks * kTileBlocks * noise.window_points) {
    plane_.sigma = noise.sigma;
    plane_.is_inlier.assign(points.size(), false);
  }

  bool Start(const Vector3d& m, int refits) {
    plane_.m = m;
    for (int i = 0; i < refits; ++i) {
      Select();
      if (!Refit()) return false;
    }
    return true;
  }

  // Leaves out tiles that are off the plane.
  bool DropTiles() {
    const std::vector<Tile> tiles = Tiles();
    std::vector<double> sizes;
    for (const Tile& tile : tiles) {
      if (tile.count < kFullTile * full_) continue;
      sizes.push_back(std::abs(tile.sum) / std::sqrt(tile.count));
    }
    if (sizes.size() < 8) return true;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const double limit =
        kOutlier * std::max(1.4826 * *middle, std::sqrt(kLeastScatter * ExpectedScatter()));
    for (size_t i = 0; i < points_.size(); ++i) {
      if (!plane_.is_inlier[i]) continue;
      const Tile& tile = tiles[PlaceOf(points_[i])];
      if (std::abs(tile.sum) > limit * std::sqrt(tile.count)) plane_.is_inlier[i] = false;
    }
    return Refit();
  }

  DepthPlane Roughly() {
    plane_.information = normal_ / ExpectedScatter();
    return plane_;
  }

  DepthPlane Finish() {
    const Matrix3d inverse = normal_.inverse();
    Matrix3d covariance = Scatter() * inverse;
    covariance += inverse * Terraces() * inverse;
    const double too_near = BlockBias();
    plane_.m *= 1.0 - too_near;
    covariance += too_near * too_near * plane_.m * plane_.m.transpose();
    plane_.information = covariance.inverse();
    return plane_;
  }

  int inliers() const { return plane_.inliers; }

 private:
  void Select() {
    const double limit = kOutlier * plane_.sigma;
    for (size_t i = 0; i < points_.size(); ++i) {
      const double expected = plane_.m.dot(points_[i].ray_D);
      plane_.is_inlier[i] = std::abs(points_[i].inverse_depth - expected) < limit &&
                            expected - limit > noise_.farthest;
    }
  }

  bool Refit() {
    normal_.setZero();
    Vector3d product = Vector3d::Zero();
    plane_.inliers = 0;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (!plane_.is_inlier[i]) continue;
      normal_.noalias() += points_[i].ray_D * points_[i].ray_D.transpose();
      product += points_[i].inverse_depth * points_[i].ray_D;
      ++plane_.inliers;
    }
    if (plane_.inliers < 4) return false;
    const Eigen::LDLT<Matrix3d> decomposition(normal_);
    if (decomposition.info() != Eigen::Success || decomposition.rcond() < 1e-9) return false;
    plane_.m = decomposition.solve(product);
    double squares = 0.0;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (plane_.is_inlier[i]) squares += std::pow(Residual(points_[i], plane_.m), 2);
    }
    plane_.sigma = std::max(least_sigma_, std::sqrt(squares / (plane_.inliers - 3)));
    return plane_.m.allFinite();
  }

  // Index of a point's tile. Tiles are counted from the image's middle outwards, so that a mirrored
  // image has mirrored tiles.
  size_t PlaceOf(const DepthPoint& point) const {
    const auto place = [this](int pixel, int count, int half) {
      return static_cast<size_t>(half + std::floor((2.0 * pixel - count + 1.0) / (2.0 * side_px_)));
    };
    const size_t column = place(point.pixel.x, noise_.image.width, half_.width);
    const size_t row = place(point.pixel.y, noise_.image.height, half_.height);
    return row * 2 * static_cast<size_t>(half_.width) + column;
  }

  std::vector<Tile> Tiles() const {
    std::vector<Tile> tiles(4 * static_cast<size_t>(half_.area()));
    for (size_t i = 0; i < points_.size(); ++i) {
      if (!plane_.is_inlier[i]) continue;
      Tile& tile = tiles[PlaceOf(points_[i])];
      tile.sum += Residual(points_[i], plane_.m);
      tile.count += 1.0;
    }
    return tiles;
  }

  // Variance of a sum of residuals per point, for matching blocks of the given size.
  double ExpectedScatter() const {
    return plane_.sigma * plane_.sigma * std::max(1.0, noise_.window_points);
  }

  double Scatter() const {
    double squares = kPredictedTiles * ExpectedScatter();
    double weight = kPredictedTiles;
    // Matching blocks that extend beyond a tile's border reduce the scatter of its mean.
    const double within = std::pow(1.0 - 1.0 / (3.0 * kTileBlocks), 2);
    for (const Tile& tile : Tiles()) {
      if (tile.count < kFullTile * full_) continue;
      squares += tile.sum * tile.sum / tile.count / within;
      weight += 1.0;
    }
    return std::max(squares / weight, kLeastScatter * ExpectedScatter());
  }

  // Relative bias of m, which is too large.
  double BlockBias() const {
    double sum = 0.0;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (plane_.is_inlier[i]) sum += points_[i].inverse_depth;
    }
    const double middle = sum / plane_.inliers;
    const double variance =
        plane_.m.head<2>().squaredNorm() * noise_.window_rad * noise_.window_rad / 12.0;
    return 2.0 * variance / (middle * middle);
  }

  // Σ over pairs of points of r rᵀ times the covariance of their quantisation errors.
  Matrix3d Terraces() const {
    const double q = noise_.step;
    if (!(q > 0.0)) return Matrix3d::Zero();
    const double noise2 = std::max(0.0, plane_.sigma * plane_.sigma - q * q / 12.0);
    const double pi = std::numbers::pi;
    const double amplitude = q / pi * std::exp(-2.0 * pi * pi * noise2 / (q * q));
    Vector3d cosines = Vector3d::Zero();
    Vector3d sines = Vector3d::Zero();
    for (size_t i = 0; i < points_.size(); ++i) {
      if (!plane_.is_inlier[i]) continue;
      const double phase = 2.0 * pi * plane_.m.dot(points_[i].ray_D) / q;
      cosines += std::cos(phase) * points_[i].ray_D;
      sines += std::sin(phase) * points_[i].ray_D;
    }
    return 0.5 * amplitude * amplitude *
           (cosines * cosines.transpose() + sines * sines.transpose());
  }

  const std::vector<DepthPoint>& points_;
  DepthNoise noise_;
  double least_sigma_;
  DepthPlane plane_{};
  Matrix3d normal_ = Matrix3d::Zero();
  int side_px_;    // Side of a tile.
  cv::Size half_;  // Number of tiles on either side of the image's middle.
  double full_;    // Number of points in a tile without holes.
};

}  // namespace

double DepthPlane::RelativeSigmaAt(const Vector3d& p_DQ) const {
  const Vector3d ray_D = p_DQ / p_DQ.z();
  const Eigen::LDLT<Matrix3d> decomposition(information);
  return std::sqrt(ray_D.dot(decomposition.solve(ray_D))) / std::abs(m.dot(ray_D));
}

double DepthPlane::Distance(const DepthPoint& point) const {
  // n = -m/|m| points towards the camera, as m·p > 0 in front of it.
  return (1.0 - m.dot(point.ray_D) / point.inverse_depth) / m.norm();
}

std::optional<DepthPlane> FindDepthPlane(const std::vector<DepthPoint>& points,
                                         const DepthNoise& noise, int least_points,
                                         const RandomStream& triples) {
  if (points.size() < static_cast<size_t>(std::max(4, least_points))) return std::nullopt;
  const auto start = MostPopular(points, noise.sigma, triples);
  if (!start) return std::nullopt;
  PlaneFitter fitter(points, noise);
  if (!fitter.Start(*start, kRefitsFound) || fitter.inliers() < least_points) return std::nullopt;
  return fitter.Roughly();
}

std::optional<DepthPlane> MeasureDepthPlane(const std::vector<DepthPoint>& points,
                                            const Vector3d& start, const DepthNoise& noise,
                                            int least_points) {
  PlaneFitter fitter(points, noise);
  if (!fitter.Start(start, kRefitsMeasured)) return std::nullopt;
  for (int i = 0; i < kTileRounds; ++i) {
    if (!fitter.DropTiles()) return std::nullopt;
  }
  if (fitter.inliers() < least_points) return std::nullopt;
  return fitter.Finish();
}

}  // namespace fenestra
