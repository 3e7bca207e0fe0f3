#include "experiments/study/sampling_design.h"

#include "core/system/check.h"

namespace fenestra {

const char* ToString(DesignMethod method) {
  switch (method) {
    case DesignMethod::kMonteCarlo:
      return "monte_carlo";
    case DesignMethod::kLatinHypercube:
      return "latin_hypercube";
    case DesignMethod::kSobol:
      return "sobol";
    case DesignMethod::kSensitivity:
      return "sensitivity";
  }
  FENESTRA_CHECK(false, "design method out of range");
}

std::optional<DesignMethod> ParseDesignMethod(std::string_view word) {
  for (const DesignMethod method : kAllDesignMethods) {
    if (word == ToString(method)) return method;
  }
  return std::nullopt;
}

}  // namespace fenestra
