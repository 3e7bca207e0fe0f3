#pragma once

#include <string>

#include "experiments/check/limit_check.h"

namespace fenestra {

/// A table of the verdicts, and what they mean.
std::string CheckForTerminal(const CheckResult& result);

/// The result as a comment on a pull request: what is violated and undecided first, what holds
/// folded away.
std::string CheckMarkdown(const CheckResult& result);

/// JUnit XML as CI systems read it: a violated limit is a failure, an undecided one skipped, or a
/// failure, too, where `undecided_fails`.
std::string CheckJunitXml(const CheckResult& result, const std::string& suite,
                          bool undecided_fails);

}  // namespace fenestra
