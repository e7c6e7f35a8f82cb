#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vulkan/memory.h"

namespace voxray {

/// An image to look at (AOV), as channels of an EXR file: "P.X" is the channel X of the layer P.
struct Aov {
    const Image* image;                 ///< RGBA32F or RGBA16F.
    std::vector<std::string> channels;  ///< Names of the image's first components.
};

/// What passes hand to each other: a plain struct of buffers and images. The pass that writes it describes
/// them in plan(), or makes them in record() where their size is counted on the device.
struct Resource {
    virtual ~Resource() = default;
    /// False for an output that nothing reads: its producer may leave it empty. Set by the graph, before
    /// plan().
    bool isRead = true;
    /// Incremented by the graph when the contents have changed (PassContext::changed).
    uint64_t version = 0;
    /// Bounces of light between a source and the surface that the camera sees, at most, as `bounces` of
    /// path_trace counts them; nullopt where it carries no indirect light or has no such bound. Of stored
    /// light those before it arrives where it is stored. Set in plan().
    std::optional<uint32_t> lightBounces;
    /// Name of the input by which its elements are numbered, such as "voxels"; empty: none. Who reads both
    /// must read the same one as the pass that wrote this.
    virtual std::string basisPort() const { return {}; }
    /// What its elements are numbered by; null where its writer reads no such input. Set by the graph.
    const Resource* basis = nullptr;
    /// Float images and float buffers that are checked for NaN and infinity after the producing pass ran.
    virtual std::vector<const Image*> checkedImages() const { return {}; }
    virtual std::vector<const Buffer*> checkedBuffers() const { return {}; }
    /// What `run --aovs` writes of it, all of one size.
    virtual std::vector<Aov> aovs() const { return {}; }
};

/// Bounces of what surfaces reflect of stored light, from Resource::lightBounces of it.
inline std::optional<uint32_t> oneMore(std::optional<uint32_t> bounces) {
    return bounces ? std::optional(*bounces + 1) : std::nullopt;
}

/// A radiance image of the frame's size: RGBA32F, linear Rec.709, W/(m² sr).
struct FrameImage : Resource {
    Image image;
    /// Of indirect light: whether what specular lobes reflect is in it. Set in plan().
    bool hasSpecularLobes = false;
    std::vector<const Image*> checkedImages() const override { return {&image}; }
};

}  // namespace voxray
