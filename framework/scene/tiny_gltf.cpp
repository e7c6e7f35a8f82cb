// tinygltf's implementation, compiled here so that sanitizers cover it.
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include "scene/tiny_gltf.h"
