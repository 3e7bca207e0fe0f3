#pragma once

#include "core/geometry/pose.h"
#include "core/random/random_stream.h"

namespace fenestra {

/// A small displacement: a rotation vector and a translation, whose six components are independent
/// and normal with mean 0 and the given standard deviations [rad], [m].
Pose RandomPose(const RandomStream& stream, double rotation_rad, double translation_m);

}  // namespace fenestra
