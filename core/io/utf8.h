#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace fenestra {

/// The offset of the first byte that is not part of a UTF-8 character (RFC 3629: neither overlong
/// forms nor surrogates nor anything above U+10FFFF); nullopt if the whole text is UTF-8.
std::optional<size_t> FirstNotUtf8(std::string_view text);

}  // namespace fenestra
