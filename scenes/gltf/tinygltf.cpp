#define TINYGLTF_IMPLEMENTATION
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenes/gltf/tinygltf.h"
