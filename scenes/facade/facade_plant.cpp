#include "scenes/facade/facade_plant.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/pose.h"

namespace fenestra {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kLeavesOfCluster = 40;
constexpr double kClusterSpread_m = 0.09;  // Standard deviation, sideways and upwards.
// Distance of a leaf's centre from the wall: leaves of usual size stay clear of it.
constexpr double kNearest_m = 0.07;
constexpr double kDepth_m = 0.12;
constexpr double kWidthPerLength = 0.65;
constexpr double kFold = 0.25;  // Height of the sides above the midrib, in widths.
// Standard deviation of the angle from a leaf's normal to the viewer's direction: leaves face the
// light.
constexpr double kTilt_rad = 0.6;
constexpr double kDarkestShade = 0.55;
constexpr double kPixelsPerLeaf = 20.0;

/// A leaf, folded along its midrib.
struct Leaf {
  Vector3d base_W;
  Vector3d tip_W;
  Vector3d left_W;
  Vector3d right_W;
};

// The parts of the frame's front that are still visible along the normal, pixel by pixel.
class FrontMap {
 public:
  FrontMap(const WindowPlan& window, double pixel_m) : low_(window.frame.low.head<2>()) {
    const Vector2d size = window.frame.high.head<2>() - low_;
    width_ = std::max(1, static_cast<int>(std::ceil(size.x() / pixel_m)));
    height_ = std::max(1, static_cast<int>(std::ceil(size.y() / pixel_m)));
    step_ = {size.x() / width_, size.y() / height_};
    in_sight_.resize(static_cast<size_t>(width_) * static_cast<size_t>(height_));
    const Box& hole = window.frame_hole;
    for (size_t i = 0; i < in_sight_.size(); ++i) {
      const Vector2d p = CentreOf(i);
      in_sight_[i] = p.x() < hole.low.x() || p.x() > hole.high.x() || p.y() < hole.low.y() ||
                     p.y() > hole.high.y();
      frame_count_ += in_sight_[i] ? 1 : 0;
    }
  }

  double Coverage() const { return static_cast<double>(covered_count_) / frame_count_; }

  /// A random place of the frame's visible part or, if there is none, of its whole front.
  Vector2d PlaceInSight(const RandomStream& random) const {
    const auto count = static_cast<double>(in_sight_.size());
    size_t pixel = 0;
    for (uint64_t i = 0; i < 2000; ++i) {
      pixel = std::min(static_cast<size_t>(random.Uniform(i) * count), in_sight_.size() - 1);
      if (in_sight_[pixel]) break;
    }
    return CentreOf(pixel);
  }

  void Cover(const Vector3d& a_W, const Vector3d& b_W, const Vector3d& c_W) {
    const Vector2d a = a_W.head<2>();
    const Vector2d b = b_W.head<2>();
    const Vector2d c = c_W.head<2>();
    const Vector2d low = a.cwiseMin(b).cwiseMin(c);
    const Vector2d high = a.cwiseMax(b).cwiseMax(c);
    const auto pixel = [this](double at, int axis, int count) {
      return std::clamp(static_cast<int>((at - low_[axis]) / step_[axis]), 0, count - 1);
    };
    const auto left_of = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
      return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    };
    const double turn = left_of(a, b, c) < 0.0 ? -1.0 : 1.0;
    for (int y = pixel(low.y(), 1, height_); y <= pixel(high.y(), 1, height_); ++y) {
      for (int x = pixel(low.x(), 0, width_); x <= pixel(high.x(), 0, width_); ++x) {
        const size_t i =
            static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
        const Vector2d p = CentreOf(i);
        if (!in_sight_[i] || turn * left_of(a, b, p) < 0.0 || turn * left_of(b, c, p) < 0.0 ||
            turn * left_of(c, a, p) < 0.0) {
          continue;
        }
        in_sight_[i] = false;
        ++covered_count_;
      }
    }
  }

 private:
  Vector2d CentreOf(size_t i) const {
    const auto width = static_cast<size_t>(width_);
    const size_t column = i % width;
    const size_t row = i / width;
    return {low_.x() + step_.x() * (static_cast<double>(column) + 0.5),
            low_.y() + step_.y() * (static_cast<double>(row) + 0.5)};
  }

  Vector2d low_;
  Vector2d step_;
  int width_ = 0;
  int height_ = 0;
  std::vector<bool> in_sight_;
  int frame_count_ = 0;
  int covered_count_ = 0;
};

Leaf GrowLeaf(const Vector2d& cluster, double length_m, const RandomStream& random) {
  const Vector3d centre_W(cluster.x() + kClusterSpread_m * random.Normal(0),
                          cluster.y() + kClusterSpread_m * random.Normal(1),
                          kNearest_m + kDepth_m * random.Uniform(2));
  const double length = length_m * (0.7 + 0.6 * random.Uniform(3));
  const double tilt = std::clamp(kTilt_rad * random.Normal(4), -1.2, 1.2);
  // Tips hang down, more or less.
  const double turn = std::numbers::pi * (random.Uniform(5) - 0.5) - 0.5 * std::numbers::pi;
  const double axis = 2.0 * std::numbers::pi * random.Uniform(6);
  const Eigen::Matrix3d R_WF =
      RotationFromVector(tilt * Vector3d(std::cos(axis), std::sin(axis), 0.0)) *
      RotationFromVector(turn * Vector3d::UnitZ());
  const double half_width = 0.5 * kWidthPerLength * length;
  const auto at = [&](double along, double across, double up) {
    return Vector3d(centre_W + R_WF * Vector3d(along, across, up));
  };
  const double lift = kFold * 2.0 * half_width;
  return {.base_W = at(-0.5 * length, 0.0, 0.0),
          .tip_W = at(0.5 * length, 0.0, 0.0),
          .left_W = at(-0.1 * length, half_width, lift),
          .right_W = at(-0.1 * length, -half_width, lift)};
}

void AddLeaf(const Leaf& leaf, float shade, Mesh& mesh) {
  const auto base = static_cast<uint32_t>(mesh.positions_W.size());
  for (const Vector3d& p_W : {leaf.base_W, leaf.tip_W, leaf.left_W, leaf.right_W}) {
    mesh.positions_W.emplace_back(p_W.x(), p_W.y(), p_W.z());
    mesh.colors.emplace_back(shade);
  }
  mesh.triangles.emplace_back(base, base + 1, base + 2);
  mesh.triangles.emplace_back(base, base + 3, base + 1);
}

}  // namespace

Mesh MakePlant(const FacadeOptions& options, const WindowPlan& window, const RandomStream& random,
               uint32_t material) {
  const PlantOptions& plant = options.plant;
  Mesh mesh{.name = "plant", .material = material};
  FrontMap front(window, plant.leaf_length_m / kPixelsPerLeaf);
  for (uint64_t cluster = 0; front.Coverage() < plant.coverage; ++cluster) {
    const RandomStream here = random.Child("cluster", cluster);
    const Vector2d place = front.PlaceInSight(here.Child("place"));
    for (uint64_t i = 0; i < kLeavesOfCluster && front.Coverage() < plant.coverage; ++i) {
      const RandomStream grown = here.Child("leaf", i);
      const Leaf leaf = GrowLeaf(place, plant.leaf_length_m, grown);
      const double shade = kDarkestShade + (1.0 - kDarkestShade) * grown.Child("shade").Uniform(0);
      AddLeaf(leaf, static_cast<float>(shade), mesh);
      front.Cover(leaf.base_W, leaf.tip_W, leaf.left_W);
      front.Cover(leaf.base_W, leaf.right_W, leaf.tip_W);
    }
  }
  return mesh;
}

}  // namespace fenestra
