#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/memory.h"
#include "vulkan/unique_handle.h"

namespace voxray {

class ShaderSources;

/// Preprocessor definitions of one variant of a shader, e.g. {{"DIRECTIONS", "6"}}.
using Defines = std::map<std::string, std::string>;

/// One reflected binding. Set 0 is pushed per dispatch; set 1 binding 0 is the scene's texture array.
struct ShaderBinding {
    std::string name;  ///< GLSL name of the block's instance or the variable.
    uint32_t set = 0;
    uint32_t binding = 0;  ///< In a module: assigned by the compiler. In a program: by name.
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    uint32_t bindingWord = 0;  ///< Index of the SPIR-V word with the binding number.
};

/// Kind of a push constant. Integers have 32 bits, signed or not.
enum class NumberKind { Integer, Float, Address, Struct };

/// A member of a shader's block of push constants.
struct ShaderPushMember {
    std::string name;
    uint32_t offset = 0;  ///< Bytes from the block's start.
    uint32_t bytes = 0;
    NumberKind kind = NumberKind::Integer;  ///< For a vector or matrix: kind of its components.
    bool operator==(const ShaderPushMember&) const = default;
};

/// A specialization constant.
struct ShaderConstant {
    std::string name;
    uint32_t id = 0;
};

/// A compiled shader stage with its reflection. Only names that the code uses are listed.
struct ShaderModule {
    std::string file;  ///< For messages.
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_COMPUTE_BIT;
    std::vector<uint32_t> spirv;
    std::string hash;  ///< Of the SPIR-V.
    std::vector<ShaderBinding> bindings;
    uint32_t pushConstantBytes = 0;  ///< Size of the block, padded to its largest scalar as in C++.
    std::vector<ShaderPushMember> pushMembers;
    std::vector<ShaderConstant> constants;
    glm::uvec3 localSize{1, 1, 1};  ///< Invocations of a compute shader's work group.
};

/// Compiles GLSL 4.60 to SPIR-V with glslang, at run time. Version and extensions are added without shifting
/// the lines of messages. Includes are searched relative to the including file, then in the source root
/// ("shaders/...", "passes/..."). SPIR-V is cached on disk by the contents of all sources, the defines and
/// the compiler's version. Modules stay in memory while none of their files changes. From any thread.
class ShaderCompiler {
 public:
    /// @param sourceRoot folder that holds shaders/ and passes/; cacheFolder may be empty: no disk cache.
    ShaderCompiler(std::filesystem::path sourceRoot, std::filesystem::path cacheFolder);
    ~ShaderCompiler();

    /// Stage by extension: .comp .vert .geom .frag .rgen .rmiss .rchit .rahit.
    /// @param file relative to the source root.
    /// @param text a compute shader that is no file: `file` is its name in messages, and next to it includes are
    /// searched; empty: the file's.
    /// @throws Error with "file:line: message" of each compile error. Errors of the cache are ignored.
    std::shared_ptr<const ShaderModule> compile(const std::string& file, const Defines& defines = {},
                                                const std::string& text = {}) const;

 private:
    class KnownModules;
    ShaderModule make(const std::string& file, const Defines& defines, const std::string& text,
                      const ShaderSources& sources) const;

    std::filesystem::path sourceRoot_;
    std::filesystem::path cacheFolder_;
    std::unique_ptr<KnownModules> known_;
};

/// A pipeline with its layout and reflected bindings. Move-only.
class Program {
 public:
    VkPipeline pipeline() const { return pipeline_; }
    VkPipelineLayout layout() const { return layout_; }
    VkPipelineBindPoint bindPoint() const { return bindPoint_; }
    VkShaderStageFlags stages() const { return stages_; }
    const std::vector<ShaderBinding>& bindings() const { return bindings_; }
    uint32_t pushConstantBytes() const { return pushConstantBytes_; }
    const std::vector<ShaderPushMember>& pushMembers() const { return pushMembers_; }
    const glm::uvec3& localSize() const { return localSize_; }
    const std::string& name() const { return name_; }

 private:
    friend class ProgramBuilder;  // program.cpp
    std::string name_;
    UniqueHandle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> pushSetLayout_;
    UniqueHandle<VkPipelineLayout, vkDestroyPipelineLayout> layout_;
    UniqueHandle<VkPipeline, vkDestroyPipeline> pipeline_;
    VkPipelineBindPoint bindPoint_ = VK_PIPELINE_BIND_POINT_COMPUTE;
    VkShaderStageFlags stages_ = 0;
    std::vector<ShaderBinding> bindings_;
    uint32_t pushConstantBytes_ = 0;
    std::vector<ShaderPushMember> pushMembers_;
    glm::uvec3 localSize_{1, 1, 1};
};

/// Values of specialization constants by name.
using SpecializationConstants = std::map<std::string, uint32_t>;

/// @throws Error if the shader uses an unsupported feature or kind of binding.
Program makeComputeProgram(Device& device, const ShaderModule& module, const SpecializationConstants& constants = {});

/// Fixed state of a raster pipeline. Vertices are pulled from storage buffers: there are no vertex inputs.
/// Viewport and scissor are dynamic; no blending.
struct RasterState {
    std::vector<VkFormat> colorFormats;
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;  ///< UNDEFINED: no depth test.
    VkCompareOp depthCompare = VK_COMPARE_OP_LESS;
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkFrontFace frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    bool writeColor = true;
    bool isConservative = false;  ///< All pixels that a triangle touches (VK_EXT_conservative_rasterization).
    uint32_t samples = 1;         ///< Per pixel, a bit of DeviceInfo::sampleCounts; without attachments alone.
    uint32_t viewports = 1;       ///< At most DeviceInfo::viewports; a geometry shader chooses by gl_ViewportIndex.
};
Program makeRasterProgram(Device& device, std::span<const ShaderModule> modules, const RasterState& state,
                          const SpecializationConstants& constants = {});

/// A ray-tracing pipeline. Groups in the modules' order: one for each .rgen and .rmiss, then one triangle hit
/// group of all .rchit and .rahit. @throws Error if the device has no ray-tracing pipelines.
Program makeRayTracingProgram(Device& device, std::span<const ShaderModule> modules,
                              const SpecializationConstants& constants = {});

}  // namespace voxray
