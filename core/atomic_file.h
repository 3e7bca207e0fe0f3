#pragma once

#include <filesystem>
#include <string_view>

namespace fenestra {

/// Writes `bytes` to a temporary file in the same folder, which is made if it is missing, and
/// renames it to `file`: readers see the old file or the whole new one. Throws InputError.
void WriteFileAtomically(const std::filesystem::path& file, std::string_view bytes);

}  // namespace fenestra
