// Random poses of both structured-light models; see depth_poses.h. Not part of the test suite.
//   check_depth_poses [POSES [SEED]]
// Exits with 1 if any pixel has a depth where nothing is.

#include <fmt/format.h>

#include <cstdlib>

#include "tests/sim/structured_light/depth_poses.h"

int main(int argc, char** argv) {
  using namespace fenestra;
  const int poses = argc > 1 ? std::atoi(argv[1]) : 100000;
  const auto seed = static_cast<uint64_t>(argc > 2 ? std::atoi(argv[2]) : 1);
  int64_t wrong = 0;
  for (const auto& [name, model] :
       {std::pair{"parametric", DepthModel::kParametric}, {"speckle", DepthModel::kMatched}}) {
    const int64_t count = testing::DepthPixelsWhereNothingIs(model, poses, seed);
    fmt::print("{}: {} wrong pixels in {} poses\n", name, count, poses);
    wrong += count;
  }
  return wrong == 0 ? 0 : 1;
}
