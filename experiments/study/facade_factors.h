#pragma once

#include "core/io/parameter_table.h"
#include "experiments/study/trial_settings.h"

namespace fenestra {

/// The factors of what only the facade has: its wall's texture, its windows' parts, the other
/// windows, the rooms and all that hangs before the wall.
void AddFacadeFactors(ParameterTable<TrialSettings>& table);

}  // namespace fenestra
