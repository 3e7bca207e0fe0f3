#pragma once

#include <span>
#include <string>

#include "experiments/analysis/error_budget.h"

namespace fenestra {

/// error_budget.csv: one line for each coordinate and cause, lengths in mm, with the indices and
/// their 95 % intervals; empty fields where there are none.
std::string ErrorBudgetCsv(std::span<const ErrorBudget> budgets);

/// A table for each cell and detector, with how to read it; empty without budgets.
std::string ErrorBudgetMarkdown(std::span<const ErrorBudget> budgets);

}  // namespace fenestra
