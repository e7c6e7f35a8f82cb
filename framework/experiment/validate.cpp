#include "experiment/validate.h"

#include "graph/graph.h"

namespace voxray {

Value referenceGraph(const Experiment& experiment) {
    Value list = Value::list();
    list.where = experiment.reference.where;
    list.items.push_back(experiment.reference);
    return list;
}

std::vector<Variant> validateExperiment(const Experiment& experiment, const Registry& registry) {
    std::vector<Variant> variants = expandSweep(experiment);
    for (const Variant& variant : variants) {
        const Graph graph(registry, variant.setup.graph);
        if (!graph.writes("final"))
            throw UsageError(variant.setup.graph.where,
                             "graph: no pass writes 'final', the image that is judged");
    }
    if (!experiment.reference.isNull()) {
        const Graph graph(registry, referenceGraph(experiment));
        for (const char* port : {"final", "indirect", "variance", "indirect_variance"})
            if (!graph.writes(port))
                throw UsageError(experiment.reference.where,
                                 "reference: the pass writes no '{}'; use path_trace", port);
    }
    return variants;
}

}  // namespace voxray
