// Compiles tinygltf's implementation, so that sanitizers see it too.
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include "scene/tiny_gltf.h"
