#include "experiments/statistics/looks.h"

#include <algorithm>

#include "core/system/check.h"

namespace fenestra {

std::vector<int> Looks(int first, int most) {
  FENESTRA_CHECK(first >= 1 && most >= 1, "looks at no trials");
  std::vector<int> looks;
  for (int trials = first; trials < most; trials += std::max(1, trials / 2)) {
    looks.push_back(trials);
    if (trials > most - trials / 2) break;  // The next one would be beyond.
  }
  looks.push_back(most);
  return looks;
}

double LookConfidence(double confidence, int looks) {
  FENESTRA_CHECK(0.0 < confidence && confidence < 1.0 && looks >= 1, "confidence of looks");
  return 1.0 - (1.0 - confidence) / looks;
}

}  // namespace fenestra
