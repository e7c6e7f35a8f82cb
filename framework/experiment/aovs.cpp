#include "experiment/aovs.h"

#include <algorithm>

#include "experiment/pixel_masks.h"
#include "experiment/readback.h"

namespace voxray {

namespace {

/// Fills an image's channels one after another.
class ChannelWriter {
 public:
    explicit ChannelWriter(ImageF& to) : to_(to) {}
    /// @param valueOf returns the channel's value by the index of the pixel.
    template <typename ValueOf>
    void add(const ValueOf& valueOf) {
        for (size_t i = 0; i < to_.pixelCount(); ++i) to_.data[i * to_.channels + next_] = valueOf(i);
        ++next_;
    }

 private:
    ImageF& to_;
    size_t next_ = 0;
};

bool isPosition(const std::string& channel) {
    return channel.starts_with("P.");
}

/// Adds channels of an AOV. @param first of the image's components. @param hits may be empty without positions.
void addChannels(ChannelWriter& writer, const std::vector<float>& texels, const std::vector<std::string>& channels,
                 size_t first, const std::vector<PrimaryHit>& hits, const glm::vec3& origin) {
    for (size_t c = 0; c < channels.size(); ++c) {
        const float offset = isPosition(channels[c]) && c < 3 ? origin[int(c)] : 0.0f;
        writer.add([&](size_t i) {
            const bool isSurface = !hits.empty() && hits[i].instance >= 0;
            return texels[i * 4 + first + c] + (isSurface ? offset : 0.0f);
        });
    }
}

void addHits(ChannelWriter& writer, const std::string& channel, const std::vector<PrimaryHit>& hits) {
    writer.add([&](size_t i) {
        if (channel == "Z") return hits[i].depth;
        return float(channel == "id" ? hits[i].instance : hits[i].material);
    });
}

}  // namespace

std::vector<AovImage> downloadAovs(const Graph& graph, const Frame& frame, const glm::vec3& origin, Device& device,
                                   CommandStream& stream) {
    std::vector<AovImage> images;
    for (const auto& [pass, aovs] : graph.aovs()) {
        const glm::uvec3 extent = aovs[0].image->desc().extent;
        std::vector<std::string> channels;
        for (const Aov& aov : aovs) {
            if (aov.image->desc().extent != extent)
                throw Error("pass '{}': its AOVs '{}' and '{}' differ in size", pass, aovs[0].image->name(),
                            aov.image->name());
            channels.insert(channels.end(), aov.channels.begin(), aov.channels.end());
        }
        channels.insert(channels.end(), std::begin(kHitChannels), std::end(kHitChannels));
        ImageF image(extent.x, extent.y, uint32_t(channels.size()));
        ChannelWriter writer(image);
        const std::vector<PrimaryHit> hits = primaryHits(*frame.scene, frame.camera, extent.x, extent.y);
        for (const Aov& aov : aovs)
            addChannels(writer, downloadFloats(device, stream, *aov.image), aov.channels, 0, hits, origin);
        for (const char* channel : kHitChannels) addHits(writer, channel, hits);
        images.push_back({pass, std::move(image), std::move(channels)});
    }
    return images;
}

ImageF hitChannel(const std::string& name, const Frame& frame, uint32_t width, uint32_t height) {
    ImageF image(width, height, 1);
    ChannelWriter writer(image);
    addHits(writer, name, primaryHits(*frame.scene, frame.camera, width, height));
    return image;
}

ImageF downloadAov(const Graph::View& view, const Frame& frame, const glm::vec3& origin, Device& device,
                   CommandStream& stream) {
    const glm::uvec3 extent = view.image->desc().extent;
    ImageF image(extent.x, extent.y, uint32_t(view.channels.size()));
    ChannelWriter writer(image);
    std::vector<PrimaryHit> hits;
    if (std::ranges::any_of(view.channels, isPosition))
        hits = primaryHits(*frame.scene, frame.camera, extent.x, extent.y);
    addChannels(writer, downloadFloats(device, stream, *view.image), view.channels, view.firstChannel, hits, origin);
    return image;
}

}  // namespace voxray
