#include "experiments/cramer_rao/prior_knowledge.h"

#include "experiments/cramer_rao/frame_state.h"

namespace fenestra {

Eigen::MatrixXd WithSizePrior(const Eigen::MatrixXd& information, const PriorKnowledge& knowledge) {
  Eigen::MatrixXd known = information;
  if (!knowledge.size_sigma_m) return known;
  const double prior = 1.0 / (*knowledge.size_sigma_m * *knowledge.size_sigma_m);
  for (const int unknown : {kWidthUnknown, kHeightUnknown}) known(unknown, unknown) += prior;
  return known;
}

}  // namespace fenestra
