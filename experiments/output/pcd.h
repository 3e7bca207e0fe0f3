#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

namespace fenestra {

/// A point cloud in the binary form of PCL's PCD format, version 0.7: x, y, z as 32-bit floats.
/// Written here, since PCL's own writer would bring VTK into the program.
std::string ToPcd(std::span<const Eigen::Vector3f> points);

}  // namespace fenestra
