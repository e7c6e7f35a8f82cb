#include "experiment/views.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "base/suggest.h"
#include "experiment/readback.h"

namespace voxray {
namespace {

using Type = ViewInfo::Type;

/// Where a view comes from.
struct Source {
    ViewInfo info;
    Graph::View view;        ///< Its first AOV for a channel that camera rays find.
    std::string hitChannel;  ///< Empty: none.
};

struct Format {
    Type type;
    uint32_t channels;
};

Format formatOf(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8_UNORM:
            return {Type::Uint8, 1};
        case VK_FORMAT_R8G8B8A8_UNORM:
        case VK_FORMAT_R8G8B8A8_SRGB:
            return {Type::Uint8, 4};
        case VK_FORMAT_R32_UINT:
            return {Type::Uint32, 1};
        case VK_FORMAT_R32G32B32A32_UINT:
            return {Type::Uint32, 4};
        case VK_FORMAT_R32_SFLOAT:
        case VK_FORMAT_D32_SFLOAT:
            return {Type::Float32, 1};
        case VK_FORMAT_R16G16_SFLOAT:
            return {Type::Float16, 2};
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return {Type::Float16, 4};
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return {Type::Float32, 4};
        default:
            throw Error("image format {} can't be shown", int(format));
    }
}

void describeImage(ViewInfo& info, const Graph::View& view) {
    const ImageDesc& desc = view.image->desc();
    const Format format = formatOf(desc.format);
    const bool isNamed = !view.channels.empty();  // AOVs and radiance: floats of fewer channels
    info.kind = view.isAov ? ViewInfo::Kind::Aov : ViewInfo::Kind::Image;
    info.type = isNamed ? Type::Float32 : format.type;
    info.channels = view.channels;
    info.quantity = format.type == Type::Uint8 ? Quantity::Fraction : view.quantity;
    if (desc.extent.z > 1) info.shape.push_back(desc.extent.z);
    info.shape.insert(info.shape.end(), {desc.extent.y, desc.extent.x});
    if (const uint64_t channels = isNamed ? view.channels.size() : format.channels; channels > 1 || desc.extent.z > 1)
        info.shape.push_back(channels);
}

Type typeOf(Elements::Type type) {
    switch (type) {
        case Elements::Type::Uint32:
            return Type::Uint32;
        case Elements::Type::Uint64:
            return Type::Uint64;
        case Elements::Type::Float32:
            return Type::Float32;
    }
    throw Error("no such type of elements");
}

void describeBuffer(ViewInfo& info, const Graph::View& view) {
    const auto& [buffer, type, components] = view.elements;
    info.kind = ViewInfo::Kind::Buffer;
    info.type = typeOf(type);
    uint64_t bytesOfElement = uint64_t(bytesOf(info.type)) * components, values = components;
    if (buffer->bytes() % bytesOfElement != 0) {
        info.type = buffer->bytes() % sizeof(uint32_t) == 0 ? Type::Uint32 : Type::Uint8;
        bytesOfElement = bytesOf(info.type);
        values = 1;
    }
    info.shape = {buffer->bytes() / bytesOfElement};
    if (values > 1) info.shape.push_back(values);
}

/// Channels that camera rays find, of a pass whose AOVs have this extent.
void addHitChannels(std::vector<Source>& sources, const Graph::View& view) {
    const glm::uvec3 extent = view.image->desc().extent;
    for (const char* channel : kHitChannels) {
        ViewInfo info{view.pass + "." + channel, view.pass, ViewInfo::Kind::Aov, Type::Float32,
                      {extent.y, extent.x},      {channel}, Quantity::Number};
        if (std::string_view(channel) == kHitChannels[0]) info.quantity = Quantity::Other;
        sources.push_back({std::move(info), view, channel});
    }
}

std::vector<Source> sourcesOf(const Graph& graph, Device& device) {
    std::vector<Source> sources;
    const std::vector<Graph::View> views = graph.views(device);
    for (size_t v = 0; v < views.size(); ++v) {
        const Graph::View& view = views[v];
        ViewInfo info;
        info.name = view.pass + "." + view.name;
        info.pass = view.pass;
        view.image ? describeImage(info, view) : describeBuffer(info, view);
        sources.push_back({std::move(info), view, {}});
        const bool isLastAov =
            view.isAov && (v + 1 == views.size() || !views[v + 1].isAov || views[v + 1].pass != view.pass);
        if (isLastAov) addHitChannels(sources, view);
    }
    return sources;
}

ViewArray readBuffer(const RenderedFrame& rendered, ViewInfo info, const Buffer& buffer, uint64_t maxValues) {
    const uint64_t values = info.shape.size() > 1 ? info.shape[1] : 1;
    const uint64_t elements = info.shape[0];
    info.shape[0] = std::min(elements, std::max<uint64_t>(maxValues / values, 1));
    const uint64_t bytes = valuesOf(info) * bytesOf(info.type);
    return {std::move(info), rendered.stream.read(buffer, bytes), elements};
}

}  // namespace

uint32_t bytesOf(ViewInfo::Type type) {
    switch (type) {
        case Type::Uint8:
            return 1;
        case Type::Float16:
            return 2;
        case Type::Uint32:
        case Type::Float32:
            return 4;
        case Type::Uint64:
            return 8;
    }
    throw Error("no such type of values");
}

uint64_t valuesOf(const ViewInfo& info) {
    return std::accumulate(info.shape.begin(), info.shape.end(), uint64_t(1), std::multiplies<>());
}

ViewArray viewOfImage(ViewInfo info, const ImageF& image, std::vector<std::string> channels) {
    info.type = Type::Float32;
    info.shape = {image.height, image.width};
    if (image.channels > 1) info.shape.push_back(image.channels);
    info.channels = std::move(channels);
    ViewArray view{std::move(info), std::vector<std::byte>(image.data.size() * sizeof(float)), 0};
    std::memcpy(view.bytes.data(), image.data.data(), view.bytes.size());
    return view;
}

ImageF imageOf(const ViewArray& view) {
    const uint32_t channels = view.shape.size() > 2 ? uint32_t(view.shape[2]) : 1;
    ImageF image(uint32_t(view.shape[1]), uint32_t(view.shape[0]), channels);
    std::memcpy(image.data.data(), view.bytes.data(), view.bytes.size());
    return image;
}

std::vector<ViewInfo> listViews(const Graph& graph, Device& device) {
    std::vector<ViewInfo> infos;
    for (Source& source : sourcesOf(graph, device)) infos.push_back(std::move(source.info));
    return infos;
}

ViewArray readView(const RenderedFrame& rendered, const std::string& name, uint64_t maxValues) {
    std::vector<Source> sources = sourcesOf(rendered.graph, rendered.device);
    const auto found = std::ranges::find_if(sources, [&](const Source& source) { return source.info.name == name; });
    if (found == sources.end()) {
        std::vector<std::string> names;
        for (const Source& source : sources) names.push_back(source.info.name);
        throw UsageError("no view '{}'{}", name, didYouMean(name, names));
    }
    auto& [info, view, channel] = *found;
    if (!view.image) return readBuffer(rendered, std::move(info), *view.elements.buffer, maxValues);
    const std::vector<std::string> channels = info.channels;
    if (!channel.empty())
        return viewOfImage(
            std::move(info),
            hitChannel(channel, rendered.frame, view.image->desc().extent.x, view.image->desc().extent.y), channels);
    if (view.isAov)
        return viewOfImage(std::move(info),
                           downloadAov(view, rendered.frame, rendered.origin, rendered.device, rendered.stream),
                           channels);
    if (!channels.empty())
        return viewOfImage(std::move(info), downloadImage(rendered.device, rendered.stream, *view.image), channels);
    return {std::move(info), downloadTexels(rendered.device, rendered.stream, *view.image), 0};
}

}  // namespace voxray
