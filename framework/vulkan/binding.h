#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "vulkan/memory.h"
#include "vulkan/program.h"

/// Resources and push constants of a call, by the names that shaders declare.
namespace voxray {

/// The value of a push constant: a number, a vector, a matrix or a plain struct.
class Number {
 public:
    template <typename T>
    explicit Number(const T& value) : kind_(kindOf(value)), bytes_(sizeof(T)) {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= sizeof(data_));
        std::memcpy(data_.data(), &value, sizeof(T));
    }
    /// Stored as 32 bits, as in GLSL.
    explicit Number(bool value) : Number(uint32_t(value)) {}

    NumberKind kind() const { return kind_; }
    uint32_t bytes() const { return bytes_; }
    const std::byte* data() const { return data_.data(); }

 private:
    template <typename T>
    static constexpr NumberKind kindOf(const T&) {
        if constexpr (std::is_floating_point_v<T>)
            return NumberKind::Float;
        else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>)
            return sizeof(T) == 8 ? NumberKind::Address : NumberKind::Integer;
        else
            return NumberKind::Struct;
    }
    template <glm::length_t L, typename T, glm::qualifier Q>
    static constexpr NumberKind kindOf(const glm::vec<L, T, Q>&) {
        return std::is_floating_point_v<T> ? NumberKind::Float : NumberKind::Integer;
    }
    template <glm::length_t C, glm::length_t R, typename T, glm::qualifier Q>
    static constexpr NumberKind kindOf(const glm::mat<C, R, T, Q>&) {
        return NumberKind::Float;
    }

    std::array<std::byte, 64> data_{};
    NumberKind kind_;
    uint32_t bytes_;
};

template <typename T>
concept IsNumber = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> && !std::derived_from<T, Buffer> &&
                   !std::derived_from<T, Image> && !std::same_as<T, TextureArray>;

/// A resource or a number for a name in a shader. An image binds as the shader declares it: as a storage
/// image (mip `level`), or sampled by `sampler`, by default nearest and clamped to the edge.
struct Binding {
    std::string_view name;
    std::variant<const Buffer*, const Image*, const TextureArray*, VkAccelerationStructureKHR, Number> value;
    const Sampler* sampler = nullptr;
    uint32_t level = 0;
    /// Ignored by programs that don't declare the name. A binding of the same name that isn't optional wins.
    bool optional = false;

    Binding(std::string_view n, const Buffer& b) : name(n), value(&b) {}
    Binding(std::string_view n, const Image& i, uint32_t mipLevel = 0) : name(n), value(&i), level(mipLevel) {}
    Binding(std::string_view n, const Image& i, const Sampler& s) : name(n), value(&i), sampler(&s) {}
    Binding(std::string_view n, const TextureArray& t) : name(n), value(&t) {}
    Binding(std::string_view n, VkAccelerationStructureKHR a) : name(n), value(a) {}
    template <IsNumber T>
    Binding(std::string_view n, const T& number) : name(n), value(Number(number)) {}
};

/// A binding for shared GLSL, ignored by programs that don't declare it.
inline Binding ifUsed(Binding binding) {
    binding.optional = true;
    return binding;
}

/// Has bindings of its own, such as a resource of a graph.
template <typename T>
concept HasBindings = requires(const T& t) {
    { t.bindings() } -> std::convertible_to<std::vector<Binding>>;
};

/// The bindings of a call, in a list such as {{"result", image}, {"count", 7u}, voxels}.
class Bindings {
 public:
    /// One entry of the list.
    struct Entry {
        std::vector<Binding> bindings;
        template <typename... More>
        Entry(std::string_view name, const More&... what) : bindings{Binding(name, what...)} {}
        Entry(Binding binding) : bindings{std::move(binding)} {}
        Entry(std::vector<Binding> list) : bindings(std::move(list)) {}
        template <HasBindings T>
        Entry(const T& resource) : bindings(resource.bindings()) {}
    };
    Bindings(std::initializer_list<Entry> entries) {
        for (const Entry& entry : entries) all_.insert(all_.end(), entry.bindings.begin(), entry.bindings.end());
    }
    const std::vector<Binding>& all() const { return all_; }

 private:
    std::vector<Binding> all_;
};

/// Minimum number of invocations of a dispatch, rounded up to work groups of the shader's local size.
class Invocations {
 public:
    /// One per element. Work groups are folded into rows of 32768 (devices allow 65535 along an axis); GLSL
    /// counterpart: linearIndex() in shaders/compute/linear_index.glsl.
    Invocations(uint64_t count) : count_(count) {}
    /// One per pixel, or per texel of a volume.
    Invocations(glm::uvec2 pixels) : Invocations(glm::uvec3(pixels, 1)) {}
    Invocations(glm::uvec3 texels) : texels_(texels), isLinear_(false) {}

    /// Whether it is a number of elements: shaders that count along one axis take it.
    bool isLinear() const { return isLinear_; }

    glm::uvec3 groups(const glm::uvec3& localSize) const {
        if (!isLinear_) return (texels_ + localSize - 1u) / localSize;
        constexpr uint64_t kRow = 32768;
        const uint64_t groups = (count_ + localSize.x - 1) / localSize.x;
        if (groups <= kRow) return {uint32_t(groups), groups > 0 ? 1 : 0, 1};
        return {uint32_t(kRow), uint32_t((groups + kRow - 1) / kRow), 1};
    }

 private:
    uint64_t count_ = 0;
    glm::uvec3 texels_{0};
    bool isLinear_ = true;
};

}  // namespace voxray
