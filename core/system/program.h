#pragma once

#include <string>

namespace fenestra {

/// "0.1.0"
const char* Version();

/// The processor's name and its widest vector instructions.
std::string Processor();

/// The widest vector instructions of this processor, which the renderer uses: "AVX-512", "AVX2" or
/// "SSE". Rows have the same bits only where this is the same.
std::string InstructionSet();

/// The name of this machine.
std::string HostName();

/// The command that started this program, quoted for a shell.
std::string CommandLine();

/// The linker's hash of the running program, in hexadecimal; empty if it has none. Two programs
/// with the same one compute the same.
const std::string& BuildId();

}  // namespace fenestra
