#pragma once

#include <string>

namespace fenestra {

/// "0.1.0"
const char* Version();

/// The processor's name and its widest vector instructions.
std::string Processor();

/// The widest vector instructions of this processor, which the renderer uses: "AVX-512", "AVX2" or
/// "SSE". Rows have the same bits only where this is the same.
std::string WidestInstructionSet();

/// The name of this machine.
std::string HostName();

/// The command that started this program, quoted for a shell.
std::string CommandLine();

/// The linker's hash of the running program, in hexadecimal; empty if it has none. Two programs
/// with the same one compute the same.
const std::string& BuildId();

/// The hash that the linker left (--build-id) in the program or shared library that `address` is
/// in, in hexadecimal; empty if it left none, or nothing is loaded there. Two files with the same
/// one hold the same code.
std::string BuildIdAt(const void* address);

/// The word as a POSIX shell reads it back: unchanged where that is safe, otherwise in single
/// quotes.
std::string ShellQuoted(const std::string& word);

/// Lets the process keep the memory of images it is done with for the next ones, up to 256 MB.
/// By default glibc gives it back and has every page zeroed again: a tenth of an image's time.
/// Without effect with other C libraries. Before threads are started.
void KeepFreedMemory();

}  // namespace fenestra
