#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace fenestra {

/// The SHA-256 (FIPS 180-4) of some bytes, as 64 hexadecimal digits.
std::string Sha256(std::string_view bytes);

/// That of a file's content. Throws InputError where it cannot be read.
std::string Sha256OfFile(const std::filesystem::path& file);

}  // namespace fenestra
