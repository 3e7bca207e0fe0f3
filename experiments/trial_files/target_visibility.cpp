#include "experiments/trial_files/target_visibility.h"

#include <algorithm>
#include <cmath>

namespace fenestra {
namespace {

constexpr int kPointsPerSide = 64;

enum class Sight { kVisible, kHidden, kTooNarrow };

/// The front outer rectangle of a window: p_C = p_CO + x right + y down.
struct Front {
  explicit Front(const WindowTruth& window)
      : p_CO(window.p_CO),
        normal_C(window.normal_C),
        right_C((window.p_CV[1] - window.p_CV[0]).normalized()),
        down_C((window.p_CV[3] - window.p_CV[0]).normalized()),
        half_m(0.5 * Eigen::Vector2d(window.width_m, window.height_m)) {}

  Eigen::Vector3d At(const Eigen::Vector2d& p) const {
    return p_CO + p.x() * right_C + p.y() * down_C;
  }

  /// Whether a point of the plane is on the border.
  bool OnBorder(const Eigen::Vector3d& p_C, double border_m) const {
    const Eigen::Vector2d p(std::abs(right_C.dot(p_C - p_CO)), std::abs(down_C.dot(p_C - p_CO)));
    const Eigen::Array2d inside_m = (half_m - p).array();
    return inside_m.minCoeff() >= 0.0 && inside_m.minCoeff() <= border_m;
  }

  Eigen::Vector3d p_CO, normal_C, right_C, down_C;
  Eigen::Vector2d half_m;
};

Sight SightOf(const TruthImages& images, const Front& front, const Eigen::Vector2d& p,
              double border_m) {
  const auto pixel = images.camera.Project(front.At(p));
  if (!pixel || !images.camera.Contains(*pixel)) return Sight::kHidden;
  const int u =
      std::clamp(static_cast<int>(std::lround(pixel->x())), 0, images.camera.width_px() - 1);
  const int v =
      std::clamp(static_cast<int>(std::lround(pixel->y())), 0, images.camera.height_px() - 1);
  const auto ray = images.camera.UnprojectRay({u, v});
  if (!ray) return Sight::kHidden;
  const double z_m = front.normal_C.dot(front.p_CO) / front.normal_C.dot(*ray);
  if (!front.OnBorder(z_m * *ray, border_m)) return Sight::kTooNarrow;
  // Depth images are of floats; nothing that matters is thinner than this.
  const double tolerance_m = 1e-3 + 1e-5 * z_m;
  const double seen_m = static_cast<double>(images.aovs.depth_m(v, u));
  return seen_m < z_m - tolerance_m ? Sight::kHidden : Sight::kVisible;
}

}  // namespace

double VisibleShare(const TruthImages& images, const WindowTruth& window, double border_m) {
  const Front front(window);
  if (front.normal_C.dot(front.p_CO) >= 0.0) return 0.0;  // Seen from behind.
  const Eigen::Vector2d middle = front.half_m.array() - 0.5 * border_m;
  int visible = 0;
  int hidden = 0;
  for (int i = 0; i < kPointsPerSide; ++i) {
    const double along = -1.0 + 2.0 * (i + 0.5) / kPointsPerSide;
    for (const double side : {-1.0, 1.0}) {
      for (const Eigen::Vector2d& place :
           {Eigen::Vector2d(along, side), Eigen::Vector2d(side, along)}) {
        const Sight sight = SightOf(images, front, place.cwiseProduct(middle), border_m);
        visible += sight == Sight::kVisible;
        hidden += sight == Sight::kHidden;
      }
    }
  }
  return visible == 0 ? 0.0 : static_cast<double>(visible) / (visible + hidden);
}

}  // namespace fenestra
