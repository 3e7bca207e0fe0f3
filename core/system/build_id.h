#pragma once

#include <string>

namespace fenestra {

/// The hash that the linker left (--build-id) in the program or shared library that `address` is
/// in, in hexadecimal; empty if it left none, or nothing is loaded there. Two files with the same
/// one hold the same code.
std::string BuildIdAt(const void* address);

}  // namespace fenestra
