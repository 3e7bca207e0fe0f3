#pragma once

#include <cstdint>
#include <filesystem>

namespace fenestra {

/// The size of all files in the folder and below it [bytes].
uint64_t FolderSize(const std::filesystem::path& folder);

}  // namespace fenestra
