#include "experiments/study/outcome.h"

#include "core/system/check.h"

namespace fenestra {

const char* ToString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kHit:
      return "hit";
    case Outcome::kGross:
      return "gross";
    case Outcome::kWrongWindow:
      return "wrong_window";
    case Outcome::kMissed:
      return "missed";
    case Outcome::kCrashed:
      return "crashed";
    case Outcome::kOutOfView:
      return "out_of_view";
    case Outcome::kFalseAlarm:
      return "false_alarm";
    case Outcome::kClear:
      return "clear";
  }
  FENESTRA_CHECK(false, "outcome out of range");
}

const char* OutcomeDefinition(Outcome outcome) {
  switch (outcome) {
    case Outcome::kHit:
      return "the estimated centroid lies within 25 % of the window's side (the smaller of its "
             "width and height) of the true one, in three dimensions";
    case Outcome::kGross:
      return "the centroid is farther off than that";
    case Outcome::kWrongWindow:
      return "the estimate is nearer to another window, and within 25 % of that window's side";
    case Outcome::kMissed:
      return "the detector reported that it found no window, with a reason";
    case Outcome::kCrashed:
      return "the detector threw, ran out of time, or returned nonsense (numbers that are not "
             "finite, a window behind the camera)";
    case Outcome::kOutOfView:
      return "the target is not wholly in view; not an attempt, counted apart";
    case Outcome::kFalseAlarm:
      return "a window was reported in a scene without one";
    case Outcome::kClear:
      return "no window was reported in a scene without one";
  }
  FENESTRA_CHECK(false, "outcome out of range");
}

std::optional<Outcome> ParseOutcome(std::string_view word) {
  for (const Outcome outcome : kAllOutcomes) {
    if (word == ToString(outcome)) return outcome;
  }
  return std::nullopt;
}

}  // namespace fenestra
