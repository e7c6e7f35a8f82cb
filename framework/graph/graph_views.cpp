#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "graph/graph.h"
#include "graph/index_resource.h"
#include "vulkan/live_memory.h"

namespace voxray {
namespace {

/// "P" of "P.X"; a channel without a layer is one.
std::string layerOf(const std::string& channel) {
    return channel.substr(0, channel.find('.'));
}

/// One view for each layer.
void addAovs(std::vector<Graph::View>& views, const std::string& pass, const Aov& aov) {
    for (size_t c = 0; c < aov.channels.size(); ++c) {
        const std::string layer = layerOf(aov.channels[c]);
        const bool begins = c == 0 || layer != layerOf(aov.channels[c - 1]);
        if (begins)
            views.push_back({.pass = pass,
                             .name = layer,
                             .image = aov.image,
                             .firstChannel = uint32_t(c),
                             .isAov = true,
                             .quantity = aov.quantity});
        views.back().channels.push_back(aov.channels[c]);
    }
}

Elements elementsOf(const GraphNode& node, const Buffer& buffer) {
    for (const auto& output : node.outputs)
        for (const Elements& elements : output->elements())
            if (elements.buffer == &buffer) return elements;
    return {&buffer};
}

/// Views of a pass by kind: AOVs, images of the frame, other images, buffers.
std::vector<Graph::View> viewsOf(const GraphNode& node, Device& device) {
    std::vector<Graph::View> aovs, frames, images, buffers;
    std::set<const Image*> listed;
    for (const auto& output : node.outputs)
        for (const Aov& aov : output->aovs())
            if (*aov.image && listed.insert(aov.image).second) addAovs(aovs, node.id, aov);
    for (size_t p = 0; p < node.ports.size(); ++p) {
        const auto* frame = node.ports[p].output ? dynamic_cast<const FrameImage*>(node.resources[p]) : nullptr;
        if (frame && frame->image && listed.insert(&frame->image).second)
            frames.push_back({.pass = node.id,
                              .name = node.ports[p].name,
                              .image = &frame->image,
                              .channels = {"R", "G", "B"},
                              .quantity = Quantity::Radiance});
    }
    for (const LiveMemory::Entry& entry : device.liveMemory().madeBy(node.memory.maker())) {
        if (entry.buffer)
            buffers.push_back(
                {.pass = node.id, .name = entry.buffer->name(), .elements = elementsOf(node, *entry.buffer)});
        else if (entry.image->desc().usage & VK_IMAGE_USAGE_TRANSFER_SRC_BIT && listed.insert(entry.image).second)
            images.push_back({.pass = node.id, .name = entry.image->name(), .image = entry.image});
    }
    std::vector<Graph::View> all = std::move(aovs);
    for (auto* more : {&frames, &images, &buffers}) std::ranges::move(*more, std::back_inserter(all));
    return all;
}

}  // namespace

void Graph::append(const Registry& registry, const Value& entry) {
    nodes_.push_back(wireLast(registry, nodes_, entry));
    try {
        bindIndexResources(nodes_);
    } catch (...) {
        nodes_.pop_back();
        throw;
    }
}

void Graph::keepAll() {
    for (GraphNode& node : nodes_) node.isReused = true;
}

void Graph::runOnlyFor(const std::string& id) {
    std::set<const Resource*> read;
    for (size_t n = nodes_.size(); n-- > 0;) {
        GraphNode& node = nodes_[n];
        const bool isNeeded = node.id == id || std::ranges::any_of(node.outputs, [&](const auto& output) {
                                  return read.contains(output.get());
                              });
        node.isSkipped = node.phase == Phase::Frame && !isNeeded;
        for (size_t p = 0; isNeeded && p < node.ports.size(); ++p)
            if (!node.ports[p].output) read.insert(node.resources[p]);
    }
}

std::vector<Graph::View> Graph::views(Device& device) const {
    std::vector<View> all;
    for (const GraphNode& node : nodes_) {
        std::map<std::string, int> counts;
        for (View& view : viewsOf(node, device)) {
            if (const int count = ++counts[view.name]; count > 1) view.name += fmt::format(" {}", count);
            all.push_back(std::move(view));
        }
    }
    return all;
}

}  // namespace voxray
