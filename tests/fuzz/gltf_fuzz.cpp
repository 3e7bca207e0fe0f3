#include "core/io/input_error.h"
#include "scenes/gltf/reader/gltf_reader.h"
#include "tests/fuzz/input_file.h"

// A libFuzzer target: any bytes at all are a scene or an InputError, and nothing else.

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fenestra::GltfReadOptions options;
  options.max_triangles = 100'000;  // So that no input is slow.
  options.max_image_pixels = 1'000'000;
  try {
    fenestra::ReadGltf(fenestra::InputFile(data, size, ".gltf"), options);
  } catch (const fenestra::InputError&) {
  }
  return 0;
}
