#pragma once

#include <filesystem>
#include <string>

namespace fenestra {

/// The extension with its dot in lower case: ".png" of "VIEW.PNG".
std::string LowerExtension(const std::filesystem::path& file);

/// Whether the name begins with a dot. Such files are a system's own, not what a user means by the
/// files of a folder: beside each picture on a foreign disk, macOS leaves a "._picture.png".
bool IsHidden(const std::filesystem::path& file);

}  // namespace fenestra
