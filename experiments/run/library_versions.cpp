#include "experiments/run/library_versions.h"

#include <fmt/format.h>
#include <pcl/pcl_config.h>
#include <sqlite3.h>

#include <Eigen/Core>
#include <opencv2/core/utility.hpp>
#include <openturns/PlatformInfo.hxx>

#include "renderers/tracing/embree_scene.h"

namespace fenestra {

std::string LibraryVersions() {
  return fmt::format("Embree {}, OpenCV {}, PCL {}, Eigen {}.{}.{}, SQLite {}, OpenTURNS {}",
                     EmbreeVersion(), cv::getVersionString(), PCL_VERSION_PRETTY,
                     EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                     sqlite3_libversion(), OT::PlatformInfo::GetVersion());
}

}  // namespace fenestra
