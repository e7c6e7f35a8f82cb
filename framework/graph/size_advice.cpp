#include "graph/size_advice.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace voxray {
namespace {

bool reads(const GraphNode& reader, const GraphNode& writer) {
    return std::ranges::any_of(writer.outputs, [&](const auto& output) {
        return std::ranges::count(reader.resources, output.get()) > 0;
    });
}

}  // namespace

std::string sizeAdvice(const std::vector<GraphNode>& nodes, const GraphNode& node) {
    std::vector<std::string> paths;
    const auto add = [&](const GraphNode& other) {
        for (const std::string& parameter : other.sizeParameters)
            paths.push_back(fmt::format("{}.{}, ", other.id, parameter));
    };
    add(node);
    for (const GraphNode& writer : nodes)
        if (&writer != &node && reads(node, writer)) add(writer);
    return fmt::format("lower what it grows with, of {}image.width, image.height", fmt::join(paths, ""));
}

}  // namespace voxray
