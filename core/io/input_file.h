#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace fenestra {

/// Opens a file for reading, as bytes. Throws InputError if there is no such file, if it is not a
/// regular one (a pipe or a device may never end) or if it may not be read, SystemError if the
/// machine fails; both with the system's reason.
std::ifstream OpenInput(const std::filesystem::path& file);

/// All bytes of a file. Throws as OpenInput does, and InputError if there are more than
/// `most_bytes` or if the file changes meanwhile.
std::string ReadWholeFile(const std::filesystem::path& file, uintmax_t most_bytes);

/// The offset of the first byte that is not part of a UTF-8 character (RFC 3629: neither overlong
/// forms nor surrogates nor anything above U+10FFFF); nullopt if the whole text is UTF-8.
std::optional<size_t> FirstNotUtf8(std::string_view text);

/// The extension with its dot in lower case: ".png" of "VIEW.PNG".
std::string LowerExtension(const std::filesystem::path& file);

/// Whether the name begins with a dot. Such files are a system's own, not what a user means by the
/// files of a folder: beside each picture on a foreign disk, macOS leaves a "._picture.png".
bool IsHidden(const std::filesystem::path& file);

}  // namespace fenestra
