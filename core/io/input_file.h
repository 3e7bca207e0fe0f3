#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace fenestra {

/// Opens a file for reading, as bytes. Throws InputError if there is no such file, if it is not a
/// regular one (a pipe or a device may never end) or if the system refuses, with its reason.
std::ifstream OpenInput(const std::filesystem::path& file);

/// All bytes of a file. Throws InputError as OpenInput does, and if there are more than
/// `most_bytes`.
std::string ReadWholeFile(const std::filesystem::path& file, uintmax_t most_bytes);

}  // namespace fenestra
