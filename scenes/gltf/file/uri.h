#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scenes/gltf/file/bytes.h"

namespace fenestra::gltf {

/// What a URI in a glTF file refers to: data inside the URI itself, or a file in the folder of the
/// glTF file or below it. Nothing else is ever opened: no other scheme, no absolute path, no way
/// out by ".." or by a symbolic link. Throws std::invalid_argument with the reason, or InputError
/// where the file itself cannot be read.
Bytes ReadUri(std::string_view uri, const std::filesystem::path& folder, ByteBudget& budget);

}  // namespace fenestra::gltf
