#include "graph/index_resource.h"

#include "base/error.h"

namespace voxray {
namespace {

std::string writerOf(const std::vector<GraphNode>& nodes, const Resource* resource) {
    for (const GraphNode& node : nodes)
        for (const std::unique_ptr<Resource>& output : node.outputs)
            if (output.get() == resource) return node.id;
    return {};
}

/// The resource that indexes an output: the writer's input of that name or its other output, else that which
/// indexes one of its inputs.
const Resource* indexResourceOf(const GraphNode& writer, const std::string& port) {
    if (const auto p = inputNamed(writer, port); p && writer.resources[*p]) return writer.resources[*p];
    if (const auto p = outputNamed(writer, port)) return writer.resources[*p];
    for (size_t p = 0; p < writer.ports.size(); ++p) {
        const Resource* input = writer.ports[p].output ? nullptr : writer.resources[p];
        if (input && input->indexResource && input->indexedBy() == port) return input->indexResource;
    }
    return nullptr;
}

}  // namespace

void bindIndexResources(const std::vector<GraphNode>& nodes) {
    for (const GraphNode& node : nodes)
        for (size_t p = 0; p < node.ports.size(); ++p) {
            Resource* resource = node.resources[p];
            const std::string port = resource ? resource->indexedBy() : "";
            if (port.empty()) continue;
            if (node.ports[p].output) {
                resource->indexResource = indexResourceOf(node, port);
                continue;
            }
            const auto index = inputNamed(node, port);
            const Resource* read = index ? node.resources[*index] : nullptr;
            if (!read || !resource->indexResource || read == resource->indexResource) continue;
            const std::string expected = writerOf(nodes, resource->indexResource), actual = writerOf(nodes, read);
            throw UsageError(node.where,
                             "{0}: '{1}' of '{2}' belongs to the {3} of '{4}', but {0} reads those of '{5}': "
                             "write 'inputs: {{{3}: {4}}}' here, or put '{5}' before '{2}'",
                             node.id, node.ports[p].name, writerOf(nodes, resource), port, expected, actual);
        }
}

}  // namespace voxray
