# One library per folder, one set of compile options for all of them.

# No -march flags here: Debian's PCL is built for baseline x86-64, and wider vectors would change
# the alignment of every Eigen type that is passed to it. Wide instruction sets are set file by
# file in renderers/ and sim/ and chosen at run time.
add_library(fenestra_options INTERFACE)
target_compile_options(fenestra_options INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual
  # GCC 12 reports these wrongly for std::string (GCC bugs 105329 and 105651).
  -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
  $<$<BOOL:${FENESTRA_WARNINGS_AS_ERRORS}>:-Werror>)
# Floating-point contraction would let the compiler round differently from one file to the next.
target_compile_options(fenestra_options INTERFACE -ffp-contract=off)
# Without these two, loops over arrays that take roots or choose between results are not vectorised.
# They change no result: nobody reads errno after sqrt, or the floating-point exception flags.
target_compile_options(fenestra_options INTERFACE -fno-math-errno -fno-trapping-math)
target_include_directories(fenestra_options INTERFACE ${CMAKE_SOURCE_DIR})
# Programs, too, since a precompiled header serves only sources with the same options and macros:
# those of the projects whose headers are in it, as well.
target_compile_options(fenestra_options INTERFACE -fPIC)
target_link_libraries(fenestra_options INTERFACE
  Eigen3::Eigen fmt::fmt glm::glm nlohmann_json::nlohmann_json opencv_core opencv_imgproc yaml-cpp)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # A quarter of the compiler's time would go into collecting garbage of a process that soon ends.
  # ccache asks for the other one.
  target_compile_options(fenestra_options INTERFACE
    --param=ggc-min-heapsize=1000000 -fpch-preprocess)
endif()
if(FENESTRA_SANITIZE)
  target_compile_options(fenestra_options INTERFACE
    -fsanitize=${FENESTRA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(fenestra_options INTERFACE -fsanitize=${FENESTRA_SANITIZE})
  # Under the address sanitizer Eigen would pad its allocations; PCL's library, which was built
  # without, hands over memory that it does not. The sanitizer's malloc is aligned to 16 bytes, too.
  target_compile_definitions(fenestra_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(FENESTRA_FUZZ)
  target_compile_options(fenestra_options INTERFACE
    -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  target_link_options(fenestra_options INTERFACE -fsanitize=address,undefined)
endif()
# Tells this build's cached results from those of others.
target_link_options(fenestra_options INTERFACE -Wl,--build-id)
find_program(MOLD mold)
if(MOLD)
  target_link_options(fenestra_options INTERFACE -fuse-ld=mold)
endif()

# How sources are compiled: each folder's in groups of at most 12, and with the headers of other
# projects read beforehand. Parsing these and instantiating their templates takes most of the time.
# fenestra_precompile(<name> <optimisation> [headers...]): headers for sources of that optimisation.
function(fenestra_precompile name optimisation)
  add_library(fenestra_precompiled_${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(fenestra_precompiled_${name} PRIVATE fenestra_options)
  target_compile_options(fenestra_precompiled_${name} PRIVATE
    $<$<CONFIG:Release>:${optimisation}>)
  target_precompile_headers(fenestra_precompiled_${name} PRIVATE
    ${PROJECT_SOURCE_DIR}/cmake/precompiled.h ${ARGN})
  set_target_properties(fenestra_precompiled_${name} PROPERTIES optimisation ${optimisation})
endfunction()
fenestra_precompile(hot -O3)
fenestra_precompile(cold -O1 <nlohmann/json.hpp>)
fenestra_precompile(test -O1 <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>)
target_link_libraries(fenestra_precompiled_test PRIVATE GTest::gmock)
# fenestra_compile(<target> <name>): as fenestra_precompile(<name> ...) says.
function(fenestra_compile target name)
  get_target_property(optimisation fenestra_precompiled_${name} optimisation)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${optimisation}>)
  target_precompile_headers(${target} REUSE_FROM fenestra_precompiled_${name})
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${FENESTRA_UNITY} UNITY_BUILD_BATCH_SIZE 12)
endfunction()

# The folders in which trials spend their time. Optimising all others as much would take more time
# than it saves.
string(JOIN "|" hot_folders
  core/geometry core/random renderers scenes/facade scenes/mesh sim
  vision/calibration vision/frame vision/rgbd vision/stereo
  experiments/cramer_rao experiments/statistics)

# fenestra_library([SOURCES ...] [PUBLIC libs...] [PRIVATE libs...]): the library of the folder whose
# CMakeLists.txt calls it, named after its path: sim/camera is fenestra::sim_camera. Without sources
# it stands for what it links.
function(fenestra_library)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${CMAKE_SOURCE_DIR}
    OUTPUT_VARIABLE folder)
  string(REPLACE "/" "_" name ${folder})
  if(ARG_SOURCES)
    add_library(fenestra_${name} STATIC ${ARG_SOURCES})
    target_link_libraries(fenestra_${name}
      PUBLIC ${ARG_PUBLIC}
      PRIVATE $<BUILD_INTERFACE:fenestra_options> ${ARG_PRIVATE})
    set(scope PUBLIC)
    if(folder MATCHES "^(${hot_folders})")
      fenestra_compile(fenestra_${name} hot)
    else()
      fenestra_compile(fenestra_${name} cold)
    endif()
  else()
    add_library(fenestra_${name} INTERFACE)
    target_link_libraries(fenestra_${name} INTERFACE ${ARG_PUBLIC})
    set(scope INTERFACE)
  endif()
  add_library(fenestra::${name} ALIAS fenestra_${name})
  target_include_directories(fenestra_${name} ${scope}
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:include/fenestra>)
  target_compile_features(fenestra_${name} ${scope} cxx_std_20)
endfunction()

# fenestra_test(<folder> SOURCES ... LIBRARIES ...): one test program per folder.
function(fenestra_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE fenestra_options ${ARG_LIBRARIES}
    GTest::gmock GTest::gtest_main)
  fenestra_compile(test_${name} test)
  # GCC 12 reports this wrongly, at -O1, for a std::optional of matrices.
  target_compile_options(test_${name} PRIVATE -Wno-maybe-uninitialized)
  # A program has the tests of many folders, whose sources are compiled together folder by folder.
  set_target_properties(test_${name} PROPERTIES UNITY_BUILD_MODE GROUP)
  # Folders only where they are named: all other objects are the same in every checkout, so that
  # the compiler cache serves them.
  foreach(source ${ARG_SOURCES})
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "${folder}" group)
    set_property(SOURCE ${source} PROPERTY UNITY_GROUP in_${group})
    file(STRINGS ${source} names_folder REGEX "FENESTRA_(SOURCE|BUILD)_DIR" LIMIT_COUNT 1)
    if(names_folder)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS
        FENESTRA_SOURCE_DIR="${CMAKE_SOURCE_DIR}" FENESTRA_BUILD_DIR="${CMAKE_BINARY_DIR}")
    endif()
  endforeach()
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." NO_PRETTY_VALUES
    DISCOVERY_TIMEOUT 60)
endfunction()
