#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vulkan/memory.h"

namespace voxray {

/// What an image's values are, which decides how it is shown (docs/look.md).
enum class Quantity {
    Radiance,   ///< Or irradiance: 0 to infinity.
    Fraction,   ///< Reflectance and others from 0 to 1.
    Direction,  ///< Components from -1 to 1.
    Number,     ///< Of a thing; -1: none.
    Other,
};

/// An AOV, as channels of an EXR file: "P.X" is the channel X of the layer P.
struct Aov {
    const Image* image;                 ///< RGBA32F or RGBA16F.
    std::vector<std::string> channels;  ///< Names of the image's first components.
    Quantity quantity = Quantity::Other;
};

/// How to read a buffer as an array: as elements of `components` values each.
struct Elements {
    enum class Type { Uint32, Uint64, Float32 };
    const Buffer* buffer;
    Type type = Type::Uint32;
    uint32_t components = 1;
};

/// Buffers and images that a pass writes and others read. The writer describes them in plan(), or makes them
/// in record() where their size is counted on the device.
struct Resource {
    virtual ~Resource() = default;
    /// False for an output that nothing reads: its writer may leave it empty. Set by the graph before plan().
    bool isRead = true;
    /// Incremented by the graph when the contents have changed (PassContext::changed).
    uint64_t version = 0;
    /// Maximum number of bounces between a light source and the surface that the camera sees (for stored
    /// light: the surface where it is stored), counted as `bounces` of path_trace; nullopt without indirect
    /// light or without a bound. Set in plan().
    std::optional<uint32_t> lightBounces;
    /// Name of the port whose elements index this resource, such as "voxels"; empty: none. A pass that reads
    /// both must read the same one as the writer of this resource.
    virtual std::string indexedBy() const { return {}; }
    /// The resource at that port of the writer; null where it reads none. Set by the graph.
    const Resource* indexResource = nullptr;
    /// Float images and float buffers that are checked for NaN and infinity after the producing pass ran.
    virtual std::vector<const Image*> checkedImages() const { return {}; }
    virtual std::vector<const Buffer*> checkedBuffers() const { return {}; }
    /// Images that `run --aovs` writes, all of one size.
    virtual std::vector<Aov> aovs() const { return {}; }
    /// How to look at buffers; others are words.
    virtual std::vector<Elements> elements() const { return {}; }
};

/// Bounces of stored light after surfaces reflect it, from its Resource::lightBounces.
inline std::optional<uint32_t> oneMoreBounce(std::optional<uint32_t> bounces) {
    return bounces ? std::optional(*bounces + 1) : std::nullopt;
}

/// A radiance image of the frame's size: RGBA32F, linear Rec.709, W/(m² sr).
struct FrameImage : Resource {
    Image image;
    /// Whether an image of indirect light includes the reflection of specular lobes. Set in plan().
    bool hasSpecularLobes = false;
    std::vector<const Image*> checkedImages() const override { return {&image}; }
};

}  // namespace voxray
