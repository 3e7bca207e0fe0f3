#pragma once

#include <string>

namespace fenestra {

/// The word as a POSIX shell reads it back: unchanged where that is safe, otherwise in single
/// quotes.
std::string ShellQuoted(const std::string& word);

}  // namespace fenestra
