#include "experiments/analysis/cell_summary.h"

namespace fenestra {

std::optional<double> HitErrors::OverBound() const {
  return bounds ? std::optional(rmse / bounds->all) : std::nullopt;
}

std::optional<double> HitErrors::DepthOverBound() const {
  return bounds ? std::optional(rmse_depth / bounds->depth) : std::nullopt;
}

Proportion MakeProportion(int count, int of) {
  return {.count = count, .of = of, .interval95 = ClopperPearson(count, of, 0.95)};
}

}  // namespace fenestra
