#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "core/input_error.h"
#include "scenes/gltf.h"

// A libFuzzer target: any bytes at all are a scene or an InputError, and nothing else.

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                            ("fenestra-fuzz-" + std::to_string(getpid()) + ".gltf");
  {
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  fenestra::GltfReadOptions options;
  options.max_triangles = 100'000;  // So that no input is slow.
  options.max_image_pixels = 1'000'000;
  try {
    fenestra::ReadGltf(file, options);
  } catch (const fenestra::InputError&) {
  }
  return 0;
}
