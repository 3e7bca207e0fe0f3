#pragma once

#include <string>

namespace fenestra {

/// "Embree 3.13.5, OpenCV 4.6.0, PCL 1.13.0, ...": the libraries in use, as they report themselves.
std::string LibraryVersions();

}  // namespace fenestra
