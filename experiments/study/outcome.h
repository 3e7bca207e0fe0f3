#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace fenestra {

/// The outcome of one trial under one detector. The definitions are the same for all studies;
/// ScoreDetection makes them, OutcomeDefinition prints them.
enum class Outcome {
  kHit,
  kGross,
  kWrongWindow,
  kMissed,
  kCrashed,
  kOutOfView,
  kFalseAlarm,
  kClear,
};

inline constexpr std::array<Outcome, 8> kAllOutcomes = {
    Outcome::kHit,     Outcome::kGross,     Outcome::kWrongWindow, Outcome::kMissed,
    Outcome::kCrashed, Outcome::kOutOfView, Outcome::kFalseAlarm,  Outcome::kClear,
};

/// "hit", "gross", "wrong_window", "missed", "crashed", "out_of_view", "false_alarm", "clear".
const char* ToString(Outcome outcome);
/// The inverse of ToString; nullopt for any other word.
std::optional<Outcome> ParseOutcome(std::string_view word);
/// One sentence for the reader of a report.
const char* OutcomeDefinition(Outcome outcome);

}  // namespace fenestra
