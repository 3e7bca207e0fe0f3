#include "experiments/study/stopping_rule.h"

#include "core/system/check.h"
#include "experiments/statistics/intervals.h"

namespace fenestra {

const char* ToString(StoppingFigure figure) {
  switch (figure) {
    case StoppingFigure::kHitRate:
      return "hit_rate";
    case StoppingFigure::kFalseAlarmRate:
      return "false_alarm_rate";
    case StoppingFigure::kP50Error:
      return "p50_error_mm";
    case StoppingFigure::kP95Error:
      return "p95_error_mm";
    case StoppingFigure::kBias:
      return "bias_mm";
    case StoppingFigure::kRmse:
      return "rmse_mm";
  }
  FENESTRA_CHECK(false, "figure out of range");
}

int StoppingRule::CountLooks(int repetitions) const {
  return static_cast<int>(Looks(first_look, repetitions).size());
}

}  // namespace fenestra
