#include "image/layers.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/error.h"
#include "base/lower_case.h"

namespace voxray {
namespace {

/// "View.Combined" and "R" of "View.Combined.R".
std::pair<std::string, std::string> splitName(const std::string& channel) {
    const size_t dot = channel.rfind('.');
    if (dot == std::string::npos) return {"", channel};
    return {channel.substr(0, dot), channel.substr(dot + 1)};
}

std::string lastWord(const std::string& layer) {
    return lowerCase(splitName(layer).second);
}

/// Channels of a layer by their lower-case names.
using ChannelNumbers = std::vector<std::pair<std::string, int>>;

int numberOf(const ChannelNumbers& channels, const char* name) {
    const auto found = std::find_if(channels.begin(), channels.end(), [&](const auto& c) { return c.first == name; });
    return found == channels.end() ? -1 : found->second;
}

/// The color or grey channels of a layer; empty if there are none.
Layer layerOf(const ChannelNumbers& channels) {
    Layer layer;
    for (const auto& names : {std::array{"r", "g", "b"}, std::array{"red", "green", "blue"}}) {
        for (const char* name : names) layer.channels.push_back(numberOf(channels, name));
        layer.isColor = std::find(layer.channels.begin(), layer.channels.end(), -1) == layer.channels.end();
        if (layer.isColor) return layer;
        layer.channels.clear();
    }
    if (channels.size() == 1 || (channels.size() == 2 && numberOf(channels, "a") >= 0)) {
        const int grey = channels[0].first == "a" ? channels.back().second : channels[0].second;
        layer.channels = {grey};
        layer.isColor = numberOf(channels, "y") == grey;
    } else if (channels.size() == 3) {
        for (const auto& [name, number] : channels) layer.channels.push_back(number);
    }
    return layer;
}

void addLayers(const OIIO::ImageSpec& spec, int part, const std::string& partName, std::vector<Layer>& layers) {
    std::map<std::string, ChannelNumbers> groups;
    for (int c = 0; c < spec.nchannels; ++c) {
        const auto [layer, channel] = splitName(spec.channelnames[size_t(c)]);
        groups[layer.empty() ? partName : layer].emplace_back(lowerCase(channel), c);
    }
    for (const auto& [name, channels] : groups) {
        Layer layer = layerOf(channels);
        if (layer.channels.empty()) continue;
        layer.name = name;
        layer.part = part;
        layers.push_back(std::move(layer));
    }
}

[[noreturn]] void refuse(const std::vector<Layer>& layers, const std::string& file, const std::string& what) {
    std::vector<std::string> names;
    for (const Layer& layer : layers) names.push_back(layer.name.empty() ? "(no name)" : layer.name);
    throw Error("{}: {}; its layers: {}", file, what, fmt::join(names, ", "));
}

/// The layers that match, or all if none does.
template <typename Matches>
std::vector<Layer> prefer(const std::vector<Layer>& layers, const Matches& matches) {
    std::vector<Layer> preferred;
    std::copy_if(layers.begin(), layers.end(), std::back_inserter(preferred), matches);
    return preferred.empty() ? layers : preferred;
}

}  // namespace

std::vector<Layer> layersOf(OIIO::ImageInput& input) {
    std::vector<Layer> layers;
    for (int part = 0; input.seek_subimage(part, 0); ++part) {
        const OIIO::ImageSpec spec = input.spec();
        addLayers(spec, part, std::string(spec.get_string_attribute("oiio:subimagename")), layers);
    }
    input.geterror();  // Clears the error of seeking past the last part
    return layers;
}

Layer chooseLayer(const std::vector<Layer>& layers, const std::string& wanted, const std::string& file) {
    if (layers.empty()) throw Error("{}: no layer of it has one or three channels", file);
    if (!wanted.empty()) {
        for (const Layer& layer : layers)
            if (layer.name == wanted) return layer;
        std::vector<Layer> found;
        std::copy_if(layers.begin(), layers.end(), std::back_inserter(found),
                     [&](const Layer& layer) { return lastWord(layer.name) == lowerCase(wanted); });
        if (found.size() != 1) refuse(layers, file, fmt::format("{} layers are called '{}'", found.size(), wanted));
        return found[0];
    }

    constexpr std::array fullImageNames{"combined", "beauty", "rgba", "rgb", "color", "final"};
    std::vector<Layer> candidates = prefer(layers, [](const Layer& layer) { return layer.isColor; });
    candidates = prefer(candidates, [](const Layer& layer) { return layer.channels.size() == 3; });
    candidates = prefer(candidates, [](const Layer& layer) { return layer.name.empty(); });
    if (candidates.size() > 1)
        candidates = prefer(candidates, [&](const Layer& layer) {
            return std::find(fullImageNames.begin(), fullImageNames.end(), lastWord(layer.name)) !=
                   fullImageNames.end();
        });
    if (candidates.size() > 1) refuse(layers, file, "it isn't clear which layer is the picture");
    return candidates[0];
}

}  // namespace voxray
