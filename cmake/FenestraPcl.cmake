# The three PCL libraries that are used. PCL's own CMake package would look for VTK and, through it,
# for MPI and Qt, whichever component is asked for; bootstrap.sh unpacks its headers alone.
set(unpacked ${PROJECT_SOURCE_DIR}/build/headers/usr/include)
find_path(PCL_INCLUDE_DIR pcl/pcl_config.h PATH_SUFFIXES pcl-1.13 HINTS ${unpacked} REQUIRED)
find_path(FLANN_INCLUDE_DIR flann/defines.h HINTS ${unpacked} REQUIRED)
add_library(fenestra_pcl INTERFACE)
target_include_directories(fenestra_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIR} ${FLANN_INCLUDE_DIR})
foreach(library common features keypoints)
  find_library(PCL_${library}_LIBRARY NAMES pcl_${library} libpcl_${library}.so.1.13 REQUIRED)
  target_link_libraries(fenestra_pcl INTERFACE ${PCL_${library}_LIBRARY})
endforeach()
target_link_libraries(fenestra_pcl INTERFACE Eigen3::Eigen Boost::headers)
