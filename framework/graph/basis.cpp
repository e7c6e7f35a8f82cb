#include "graph/basis.h"

#include "base/error.h"

namespace voxray {
namespace {

Resource* portNamed(const GraphNode& node, const std::string& name, bool isOutput) {
    for (size_t p = 0; p < node.ports.size(); ++p)
        if (node.ports[p].output == isOutput && node.ports[p].name == name) return node.resources[p];
    return nullptr;
}

std::string writerOf(const std::vector<GraphNode>& nodes, const Resource* resource) {
    for (const GraphNode& node : nodes)
        for (const std::unique_ptr<Resource>& output : node.outputs)
            if (output.get() == resource) return node.id;
    return {};
}

/// What an output's elements are numbered by: the writer's input of that name or its other output, else the
/// basis of what it reads.
const Resource* basisOf(const GraphNode& writer, const std::string& port) {
    if (const Resource* own = portNamed(writer, port, false)) return own;
    if (const Resource* own = portNamed(writer, port, true)) return own;
    for (size_t p = 0; p < writer.ports.size(); ++p) {
        const Resource* input = writer.ports[p].output ? nullptr : writer.resources[p];
        if (input && input->basis && input->basisPort() == port) return input->basis;
    }
    return nullptr;
}

}  // namespace

void bindBases(const std::vector<GraphNode>& nodes) {
    for (const GraphNode& node : nodes)
        for (size_t p = 0; p < node.ports.size(); ++p) {
            Resource* resource = node.resources[p];
            const std::string port = resource ? resource->basisPort() : "";
            if (port.empty()) continue;
            if (node.ports[p].output) {
                resource->basis = basisOf(node, port);
                continue;
            }
            const Resource* read = portNamed(node, port, false);
            if (!read || !resource->basis || read == resource->basis) continue;
            const std::string maker = writerOf(nodes, resource->basis), other = writerOf(nodes, read);
            throw UsageError(node.where,
                             "{0}: '{1}' of '{2}' belongs to the {3} of '{4}', but {0} reads those of '{5}': "
                             "write 'inputs: {{{3}: {4}}}' here, or put '{5}' before '{2}'",
                             node.id, node.ports[p].name, writerOf(nodes, resource), port, maker, other);
        }
}

}  // namespace voxray
