// GLSL's type names for C++, so that headers can share structs. GLSL blocks use scalar layout, which is that
// of C++ structs with 4-byte members; tests/gpu/shared_structs_test.cpp checks the offsets.
#ifndef VOXRAY_SHARED_TYPES_H
#define VOXRAY_SHARED_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace voxray::gpu {
using uint = uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using ivec3 = glm::ivec3;
using mat4 = glm::mat4;
}  // namespace voxray::gpu
#define VOXRAY_SHARED_BEGIN namespace voxray::gpu {
#define VOXRAY_SHARED_END }
#else
#define VOXRAY_SHARED_BEGIN
#define VOXRAY_SHARED_END
#endif

#endif
