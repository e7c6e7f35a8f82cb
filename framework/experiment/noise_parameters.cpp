#include "experiment/noise_parameters.h"

#include <algorithm>

#include "config/overrides.h"
#include "graph/graph.h"

namespace voxray {

std::vector<std::string> noiseParameters(const Variant& variant, const Registry& registry,
                                         const std::string& port) {
    Graph graph(registry, variant.setup.graph);
    if (!graph.writes(port)) return {};
    graph.keepOnly({port});
    std::vector<std::string> paths;
    for (const Value& pass : graph.resolved().items) {
        const std::string id = passId(pass);
        const PassKind& kind = registry.require(pass.find("pass")->scalar, pass.where);
        const std::vector<IdleParameter> idle = kind.idle(pass, id, Graph::reservedKeys());
        for (const ParameterDoc& parameter : kind.parameters)
            if (parameter.isLessNoise && std::ranges::count(idle, parameter.name, &IdleParameter::name) == 0)
                paths.push_back(id + "." + parameter.name);
    }
    return paths;
}

}  // namespace voxray
