#include "experiment/aovs.h"

#include <glm/gtc/packing.hpp>

#include "experiment/pixel_masks.h"

namespace voxray {
namespace {

/// All four components of an image of floats or half floats.
std::vector<float> downloadTexels(Device& device, CommandStream& stream, const Image& image) {
    const ImageDesc& desc = image.desc();
    const uint64_t values = uint64_t(desc.extent.x) * desc.extent.y * 4;
    const Buffer buffer(device, image.name() + " readback", values / 4 * texelBytes(desc.format),
                        MemoryKind::Readback);
    stream.copy(image, buffer);
    if (desc.format == VK_FORMAT_R32G32B32A32_SFLOAT) return stream.readAs<float>(buffer, values);
    if (desc.format != VK_FORMAT_R16G16B16A16_SFLOAT)
        throw Error("image '{}' is neither RGBA32F nor RGBA16F and can't be an AOV", image.name());
    std::vector<float> texels;
    texels.reserve(values);
    for (const uint16_t half : stream.readAs<uint16_t>(buffer, values))
        texels.push_back(glm::unpackHalf1x16(half));
    return texels;
}

/// An image with room for `channels`, a number of them filled so far.
class ChannelWriter {
 public:
    ChannelWriter(AovImage& to, uint32_t width, uint32_t height, size_t channels) : to_(to) {
        to_.image = ImageF(width, height, uint32_t(channels));
    }
    /// @param valueOf the channel's value in a pixel, by its number.
    template <typename ValueOf>
    void add(const std::string& name, const ValueOf& valueOf) {
        const size_t channel = to_.channels.size(), stride = to_.image.channels;
        for (size_t i = 0; i < to_.image.pixelCount(); ++i) to_.image.data[i * stride + channel] = valueOf(i);
        to_.channels.push_back(name);
    }

 private:
    AovImage& to_;
};

}  // namespace

std::vector<AovImage> downloadAovs(const Graph& graph, const Frame& frame, const glm::vec3& origin,
                                   Device& device, CommandStream& stream) {
    std::vector<AovImage> images;
    for (const auto& [pass, aovs] : graph.aovs()) {
        const glm::uvec3 extent = aovs[0].image->desc().extent;
        size_t channels = 3;
        for (const Aov& aov : aovs) {
            if (aov.image->desc().extent != extent)
                throw Error("pass '{}': its AOVs '{}' and '{}' differ in size", pass, aovs[0].image->name(),
                            aov.image->name());
            channels += aov.channels.size();
        }
        AovImage& image = images.emplace_back(AovImage{pass, {}, {}});
        ChannelWriter writer(image, extent.x, extent.y, channels);
        const std::vector<PrimaryHit> hits = primaryHits(*frame.scene, frame.camera, extent.x, extent.y);
        for (const Aov& aov : aovs) {
            const std::vector<float> texels = downloadTexels(device, stream, *aov.image);
            for (size_t c = 0; c < aov.channels.size(); ++c) {
                const float offset = aov.channels[c].starts_with("P.") && c < 3 ? origin[int(c)] : 0.0f;
                writer.add(aov.channels[c], [&](size_t i) {
                    return texels[i * 4 + c] + (hits[i].instance >= 0 ? offset : 0.0f);
                });
            }
        }
        writer.add("Z", [&](size_t i) { return hits[i].depth; });
        writer.add("id", [&](size_t i) { return float(hits[i].instance); });
        writer.add("material_id", [&](size_t i) { return float(hits[i].material); });
    }
    return images;
}

void writeAovs(const std::filesystem::path& folder, const std::vector<AovImage>& aovs) {
    for (const AovImage& aov : aovs)
        writeExr(folder / ("aovs." + aov.pass + ".exr"), aov.image, aov.channels);
}

}  // namespace voxray
