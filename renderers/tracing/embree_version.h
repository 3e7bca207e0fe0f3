#pragma once

#include <string>

namespace fenestra {

/// "3.13.5": of the Embree library that is loaded.
std::string EmbreeVersion();

}  // namespace fenestra
