#include "experiments/study/stopping_rule.h"

#include "experiments/statistics/intervals.h"

namespace fenestra {

int StoppingRule::CountLooks(int repetitions) const {
  return static_cast<int>(Looks(first_look, repetitions).size());
}

}  // namespace fenestra
