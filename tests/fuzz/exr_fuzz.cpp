#include "core/io/input_error.h"
#include "renderers/exr_io.h"
#include "tests/fuzz/input_file.h"

// A libFuzzer target: any bytes at all are an OpenEXR image or an InputError.

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    fenestra::ReadExr(fenestra::InputFile(data, size, ".exr"),
                      {.most_values = 100'000});  // So that no input is slow.
  } catch (const fenestra::InputError&) {
  }
  return 0;
}
