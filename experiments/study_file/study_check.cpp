#include "experiments/study_file/study_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

// The corners of a box in k dimensions are 2^k; a study that draws more sizes than this at once
// learns of a contradiction between the further ones from the trial that meets it.
constexpr size_t kMostCornerFactors = 8;
// A normal distribution's ends are so far out that nothing is ever drawn there.
constexpr double kCornerProbability = 1e-6;
constexpr size_t kFewestEnvelopeLevels = 3;

bool AreRisingNumbers(const Levels& levels) {
  for (size_t i = 0; i < levels.size(); ++i) {
    const double* number = std::get_if<double>(&levels[i]);
    if (number == nullptr || (i > 0 && *number <= std::get<double>(levels[i - 1]))) return false;
  }
  return levels.size() >= kFewestEnvelopeLevels;
}

bool MayContradict(FactorGroup group) {
  return group != FactorGroup::kViewpoint && group != FactorGroup::kLight;
}

std::optional<std::string> Complaint(const TrialSettings& settings, SensorKind sensor) {
  try {
    Validate(settings, sensor);
  } catch (const InputError& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }
  return std::nullopt;
}

// The cell's settings with its drawn factors at all combinations of low and high values.
std::vector<TrialSettings> Corners(const Study& study, const Cell& cell) {
  std::vector<TrialSettings> corners{cell.settings};
  size_t corner_factors = 0;
  for (const auto& [factor, distribution] : DrawnFactors(study, cell)) {
    const bool both = MayContradict(GroupOf(factor)) && corner_factors++ < kMostCornerFactors;
    const double low = Quantile(distribution, both ? kCornerProbability : 0.5);
    const double high = Quantile(distribution, 1.0 - kCornerProbability);
    std::vector<TrialSettings> next;
    for (TrialSettings& corner : corners) {
      Factors().Set(corner, factor, low);
      next.push_back(corner);
      Factors().Set(corner, factor, high);
      if (both) next.push_back(corner);
    }
    corners = std::move(next);
  }
  return corners;
}

// The levels that tell the scenes and sensors of one part apart.
std::string ConstructionOf(const Cell& cell) {
  std::string key = ToString(cell.sensor);
  for (const auto& [factor, value] : cell.levels) {
    if (MayContradict(GroupOf(factor))) key += fmt::format(" {}={}", factor, ToString(value));
  }
  return key;
}

std::string Blame(const StudyPart& part, const TrialSettings& settings, SensorKind sensor) {
  for (const Factor& factor : part.factors) {
    const ParameterValue standard = Factors().Find(factor.name)->default_value;
    if (!MayContradict(GroupOf(factor.name)) || Factors().Get(settings, factor.name) == standard) {
      continue;
    }
    TrialSettings changed = settings;
    Factors().Set(changed, factor.name, standard);
    if (!Complaint(changed, sensor)) return factor.name;
  }
  return "";
}

}  // namespace

std::vector<Contradiction> FindContradictions(const Study& study) {
  std::vector<Contradiction> contradictions;
  std::set<std::pair<size_t, std::string>> tried;
  std::set<std::pair<size_t, std::string>> blamed;
  for (const Cell& cell : Cells(study)) {
    if (!tried.insert({cell.part_index, ConstructionOf(cell)}).second) continue;
    for (const TrialSettings& corner : Corners(study, cell)) {
      const auto complaint = Complaint(corner, cell.sensor);
      if (!complaint) continue;
      const std::string factor = Blame(study.parts[cell.part_index], corner, cell.sensor);
      if (blamed.insert({cell.part_index, factor}).second) {
        contradictions.push_back({cell.part_index, factor, *complaint});
      }
      break;
    }
  }
  return contradictions;
}

std::vector<std::string> RuleObjections(const StudyPart& part) {
  std::vector<std::string> objections;
  const bool rows = part.design.method == DesignMethod::kSensitivity;
  if (part.until && part.envelope) objections.push_back("until and envelope exclude each other");
  if (rows && part.until) objections.push_back("a sensitivity design has no use for until");
  if (rows && part.envelope) objections.push_back("a sensitivity design has no use for envelope");
  if (!part.envelope) return objections;
  const EnvelopeRule& rule = *part.envelope;
  const auto over = std::find_if(part.factors.begin(), part.factors.end(),
                                 [&rule](const Factor& f) { return f.name == rule.over; });
  const Levels* levels = over == part.factors.end() ? nullptr : std::get_if<Levels>(&over->setting);
  if (levels == nullptr || !AreRisingNumbers(*levels)) {
    objections.push_back(
        fmt::format("the envelope needs at least {} rising numbers as levels of "
                    "{}, such as {{from: 1, to: 9, step: 0.25}}",
                    kFewestEnvelopeLevels, rule.over));
  }
  for (const SensorKind sensor : part.sensors) {
    if (Concerns(GroupOf(rule.over), sensor)) continue;
    objections.push_back(fmt::format("{} has no effect on {}", rule.over, ToString(sensor)));
  }
  if (!AllGoodSuffice(rule, part.repetitions)) {
    int enough = part.repetitions;
    while (!AllGoodSuffice(rule, enough)) enough += 1 + enough / 100;
    objections.push_back(
        fmt::format("{} repetitions cannot show the requirement with {:g} % "
                    "confidence even if all are good; about {} can",
                    part.repetitions, 100.0 * rule.confidence, enough));
  }
  return objections;
}

std::string WhyWithoutEffect(const std::string& factor, const StudyPart& part) {
  const FactorGroup group = GroupOf(factor);
  const auto concerns = [group](SensorKind sensor) { return Concerns(group, sensor); };
  if (std::none_of(part.sensors.begin(), part.sensors.end(), concerns)) {
    return fmt::format("{} has no effect: part '{}' uses another sensor", factor, part.name);
  }
  const auto scene = std::find_if(part.factors.begin(), part.factors.end(),
                                  [](const Factor& f) { return f.name == "scene"; });
  const Levels scenes = scene == part.factors.end() ? Levels{TrialSettings{}.scene}
                                                    : std::get<Levels>(scene->setting);
  const bool any_facade =
      std::find(scenes.begin(), scenes.end(), ParameterValue(kFacadeScene)) != scenes.end();
  if (group == FactorGroup::kFacade && !any_facade) {
    return fmt::format("{} has no effect on the painted target; it needs scene: {}", factor,
                       kFacadeScene);
  }
  return "";
}

}  // namespace fenestra
