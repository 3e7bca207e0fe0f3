#pragma once

// tinygltf is compiled from its header rather than linked as Debian's library, so that it comes
// without file access and without image decoders: neither can then be led astray by a file. The
// macros change its classes, so every inclusion goes through here.
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>
