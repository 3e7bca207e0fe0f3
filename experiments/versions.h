#pragma once

#include <string>

namespace fenestra {

/// "0.1.0"
const char* Version();

/// "Embree 3.13.5, OpenCV 4.6.0, PCL 1.13.0, ...": the libraries in use, as they report themselves.
std::string LibraryVersions();

/// The processor's name and its widest vector instructions.
std::string Processor();

}  // namespace fenestra
