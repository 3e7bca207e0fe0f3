#include "experiments/output/pcd.h"

#include <fmt/format.h>

namespace fenestra {

std::string ToPcd(std::span<const Eigen::Vector3f> points) {
  std::string file = fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
      "TYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\n"
      "DATA binary\n",
      points.size());
  static_assert(sizeof(Eigen::Vector3f) == 12);
  if (!points.empty()) {
    file.append(reinterpret_cast<const char*>(points.data()), points.size() * 12);
  }
  return file;
}

}  // namespace fenestra
