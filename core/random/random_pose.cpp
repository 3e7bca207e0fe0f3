#include "core/random/random_pose.h"

namespace fenestra {
namespace {

Eigen::Vector3d NormalVector(const RandomStream& stream, double sigma) {
  return sigma * Eigen::Vector3d(stream.Normal(0), stream.Normal(1), stream.Normal(2));
}

}  // namespace

Pose RandomPose(const RandomStream& stream, double rotation_rad, double translation_m) {
  return Pose(RotationFromVector(NormalVector(stream.Child("rotation"), rotation_rad)),
              NormalVector(stream.Child("translation"), translation_m));
}

}  // namespace fenestra
