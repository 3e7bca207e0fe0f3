#pragma once

namespace fenestra {

/// Lets the process keep the memory of images it is done with for the next ones, up to 256 MB.
/// By default glibc gives it back and has every page zeroed again: a tenth of a frame's time.
/// Without effect with other C libraries. Before threads are started.
void KeepFreedMemory();

}  // namespace fenestra
