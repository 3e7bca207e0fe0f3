#include "sim/truth/ground_truth.h"

namespace fenestra {
namespace {

bool IsInView(const WindowTruth& window, const CameraModel& camera) {
  if (!(window.normal_C.dot(window.p_CO) < 0.0)) return false;  // Seen from behind.
  for (const Eigen::Vector3d& p_CV : window.p_CV) {
    const auto pixel = camera.Project(p_CV);
    if (!pixel || !camera.Contains(*pixel)) return false;
  }
  return true;
}

}  // namespace

WindowTruth TruthOf(const TargetWindow& window, const Pose& X_WC) {
  const Pose X_CW = X_WC.inverse();
  WindowTruth truth{.p_CO = X_CW * window.Centroid_W(),
                    .p_CV = window.Corners_W(),
                    .normal_C = X_CW.rotation() * window.X_WO.rotation().col(2),
                    .width_m = window.width_m,
                    .height_m = window.height_m};
  for (Eigen::Vector3d& corner : truth.p_CV) corner = X_CW * corner;
  return truth;
}

GroundTruth MakeGroundTruth(const Scene& scene, const Pose& X_WC,
                            std::span<const PlacedCamera> cameras) {
  GroundTruth truth{.X_WC = X_WC, .target = {}, .other_windows = {}};
  for (const TargetWindow& window : scene.other_windows) {
    truth.other_windows.push_back(TruthOf(window, X_WC));
  }
  if (!scene.target) return truth;
  truth.target = TruthOf(*scene.target, X_WC);
  truth.in_view = true;
  for (const PlacedCamera& placed : cameras) {
    truth.in_view = truth.in_view && IsInView(TruthOf(*scene.target, placed.X_WC), placed.camera);
  }
  return truth;
}

}  // namespace fenestra
