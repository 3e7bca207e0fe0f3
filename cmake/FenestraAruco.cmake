# OpenCV's ArUco markers; bootstrap.sh unpacks their headers alone.
if(NOT TARGET opencv_aruco)
  find_path(ARUCO_INCLUDE_DIR opencv2/aruco.hpp PATH_SUFFIXES opencv4
    HINTS ${PROJECT_SOURCE_DIR}/build/headers/usr/include REQUIRED)
  find_library(ARUCO_LIBRARY NAMES opencv_aruco libopencv_aruco.so.406 REQUIRED)
  add_library(opencv_aruco UNKNOWN IMPORTED)
  set_target_properties(opencv_aruco PROPERTIES
    IMPORTED_LOCATION ${ARUCO_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${ARUCO_INCLUDE_DIR})
endif()
