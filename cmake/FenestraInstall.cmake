# `cmake --install`: the program, and what detectors of one's own are built against.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Fenestra)

install(TARGETS fenestra)
foreach(library core core_detection core_geometry core_io core_random core_system)
  set_target_properties(fenestra_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS fenestra_${library} EXPORT FenestraTargets)
endforeach()
install(DIRECTORY core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fenestra
  FILES_MATCHING PATTERN "*.h")
install(FILES vision/detector_plugin.h vision/detector_info.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fenestra/vision)
install(EXPORT FenestraTargets NAMESPACE fenestra:: DESTINATION ${package_dir})
configure_package_config_file(cmake/FenestraConfig.cmake.in
  ${CMAKE_BINARY_DIR}/FenestraConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/FenestraConfigVersion.cmake
  COMPATIBILITY ExactVersion)
install(FILES cmake/FenestraOpenCV.cmake
  ${CMAKE_BINARY_DIR}/FenestraConfig.cmake ${CMAKE_BINARY_DIR}/FenestraConfigVersion.cmake
  DESTINATION ${package_dir})
