#include "vulkan/reflect.h"

#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "base/error.h"

namespace voxray {
namespace {

struct DestroyContext {
    void operator()(spvc_context context) const { spvc_context_destroy(context); }
};
using Context = std::unique_ptr<spvc_context_s, DestroyContext>;

/// SPIRV-Cross on one module, listing only the variables that the code uses.
class Reflection {
 public:
    explicit Reflection(const ShaderModule& module) : file_(module.file) {
        spvc_context context = nullptr;
        if (spvc_context_create(&context) != SPVC_SUCCESS) throw Error("{}: out of memory", file_);
        context_.reset(context);
        spvc_parsed_ir ir = nullptr;
        check(spvc_context_parse_spirv(context, module.spirv.data(), module.spirv.size(), &ir));
        check(
            spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
        spvc_set active = nullptr;
        check(spvc_compiler_get_active_interface_variables(compiler_, &active));
        check(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources_, active));
    }

    void addBindings(spvc_resource_type kind, VkDescriptorType type, std::vector<ShaderBinding>& bindings) const {
        for (const spvc_reflected_resource& resource : list(kind)) {
            // A block's instance name, else its type's name; a variable's name.
            std::string name = spvc_compiler_get_name(compiler_, resource.id);
            if (name.empty()) name = spvc_compiler_get_name(compiler_, resource.base_type_id);
            ShaderBinding binding{name, decoration(resource, SpvDecorationDescriptorSet),
                                  decoration(resource, SpvDecorationBinding), type};
            if (!spvc_compiler_get_binary_offset_for_decoration(compiler_, resource.id, SpvDecorationBinding,
                                                                &binding.bindingWord))
                throw Error("{}: '{}' has no binding", file_, name);

            // Set 0 has single descriptors, set 1 the scene's textures.
            const spvc_type handle = spvc_compiler_get_type_handle(compiler_, resource.type_id);
            const bool isArray = spvc_type_get_num_array_dimensions(handle) > 0;
            const bool isTextureArray =
                binding.set == 1 && isArray && type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
            if (!isTextureArray && (binding.set != 0 || isArray))
                throw Error(
                    "{}: '{}' (set {}) is not supported: "
                    "use single bindings in set 0, and 'sampler2D textures[]' in set 1",
                    file_, name, binding.set);
            bindings.push_back(std::move(binding));
        }
    }

    void refuse(spvc_resource_type kind, const char* what) const {
        if (list(kind).empty()) return;
        throw Error("{}: '{}' is {}, which is not supported", file_, list(kind)[0].name, what);
    }

    /// Bytes of the push-constant block, padded to the alignment of its largest scalar as C++ does.
    uint32_t pushConstantBytes() const {
        const auto blocks = list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT);
        if (blocks.empty()) return 0;
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, blocks[0].base_type_id);
        size_t bytes = 0;
        check(spvc_compiler_get_declared_struct_size(compiler_, type, &bytes));
        const size_t alignment = has64BitMember(type) ? 8 : 4;
        return uint32_t((bytes + alignment - 1) / alignment * alignment);
    }

    std::vector<ShaderPushMember> pushMembers() const {
        const auto blocks = list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT);
        if (blocks.empty()) return {};
        const spvc_type_id id = blocks[0].base_type_id;
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, id);
        std::vector<ShaderPushMember> members(spvc_type_get_num_member_types(type));
        for (unsigned i = 0; i < members.size(); ++i) {
            size_t bytes = 0;
            members[i].name = spvc_compiler_get_member_name(compiler_, id, i);
            check(spvc_compiler_type_struct_member_offset(compiler_, type, i, &members[i].offset));
            check(spvc_compiler_get_declared_struct_member_size(compiler_, type, i, &bytes));
            members[i].bytes = uint32_t(bytes);
            members[i].kind = kindOf(spvc_compiler_get_type_handle(compiler_, spvc_type_get_member_type(type, i)));
        }
        return members;
    }

    std::vector<ShaderConstant> constants() const {
        const spvc_specialization_constant* constants = nullptr;
        size_t count = 0;
        check(spvc_compiler_get_specialization_constants(compiler_, &constants, &count));
        std::vector<ShaderConstant> found;
        for (size_t i = 0; i < count; ++i)
            found.push_back({spvc_compiler_get_name(compiler_, constants[i].id), constants[i].constant_id});
        return found;
    }

    glm::uvec3 localSize() const {
        glm::uvec3 size;
        for (unsigned axis = 0; axis < 3; ++axis)
            size[int(axis)] =
                spvc_compiler_get_execution_mode_argument_by_index(compiler_, SpvExecutionModeLocalSize, axis);
        return size;
    }

 private:
    void check(spvc_result result) const {
        if (result != SPVC_SUCCESS)
            throw Error("{}: can't reflect the shader: {}", file_, spvc_context_get_last_error_string(context_.get()));
    }

    std::span<const spvc_reflected_resource> list(spvc_resource_type kind) const {
        const spvc_reflected_resource* items = nullptr;
        size_t count = 0;
        check(spvc_resources_get_resource_list_for_type(resources_, kind, &items, &count));
        return {items, count};
    }

    uint32_t decoration(const spvc_reflected_resource& resource, SpvDecoration what) const {
        return spvc_compiler_get_decoration(compiler_, resource.id, what);
    }

    static NumberKind kindOf(spvc_type type) {
        if (spvc_type_get_storage_class(type) == SpvStorageClassPhysicalStorageBuffer) return NumberKind::Address;
        switch (spvc_type_get_basetype(type)) {
            case SPVC_BASETYPE_FP32:
                return NumberKind::Float;
            case SPVC_BASETYPE_INT64:
            case SPVC_BASETYPE_UINT64:
                return NumberKind::Address;
            case SPVC_BASETYPE_STRUCT:
                return NumberKind::Struct;
            default:
                return NumberKind::Integer;
        }
    }

    bool has64BitMember(spvc_type type) const {
        if (spvc_type_get_storage_class(type) == SpvStorageClassPhysicalStorageBuffer) return true;
        if (spvc_type_get_basetype(type) != SPVC_BASETYPE_STRUCT) return spvc_type_get_bit_width(type) == 64;
        for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
            const spvc_type_id member = spvc_type_get_member_type(type, i);
            if (has64BitMember(spvc_compiler_get_type_handle(compiler_, member))) return true;
        }
        return false;
    }

    std::string file_;
    Context context_;
    spvc_compiler compiler_ = nullptr;
    spvc_resources resources_ = nullptr;
};

}  // namespace

void reflect(ShaderModule& module) {
    const Reflection reflection(module);
    constexpr std::array kinds{
        std::pair{SPVC_RESOURCE_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
        std::pair{SPVC_RESOURCE_TYPE_STORAGE_IMAGE, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
        std::pair{SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
        std::pair{SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR}};
    module.bindings.clear();
    for (const auto& [kind, type] : kinds) reflection.addBindings(kind, type, module.bindings);
    reflection.refuse(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, "a uniform buffer (use a readonly storage buffer)");
    reflection.refuse(SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, "a separate image (use sampler2D or sampler3D)");
    reflection.refuse(SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, "a separate sampler (use sampler2D or sampler3D)");
    reflection.refuse(SPVC_RESOURCE_TYPE_SUBPASS_INPUT, "a subpass input");
    module.pushConstantBytes = reflection.pushConstantBytes();
    module.pushMembers = reflection.pushMembers();
    module.constants = reflection.constants();
    if (module.stage == VK_SHADER_STAGE_COMPUTE_BIT) module.localSize = reflection.localSize();
}

}  // namespace voxray
