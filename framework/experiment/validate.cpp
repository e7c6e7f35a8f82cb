#include "experiment/validate.h"

#include "config/overrides.h"
#include "graph/graph.h"

namespace voxray {
namespace {

void checkPassName(const Value& pass, const Registry& registry) {
    const Value* name = pass.isMap() ? pass.find("pass") : &pass;
    if (name && name->isScalar()) registry.require(name->scalar, name->where);
}

// Names of passes, before the sweep's paths are looked up among their ids: a pass that is misspelt in the
// graph would else be told as a misspelt path.
void checkPassNames(const Experiment& experiment, const Registry& registry) {
    for (const Value& entry : experiment.setup.graph.items) checkPassName(entry, registry);
    for (const auto& [path, values] : experiment.sweep.members)
        for (const Value& entry : experiment.setup.graph.items)
            if (passId(entry) == path)
                for (const Value& value : values.items) checkPassName(value, registry);
}

}  // namespace

Graph variantGraph(const Variant& variant, const Registry& registry, std::vector<std::string>* leftOut) {
    Graph graph(registry, variant.setup.graph);
    const std::vector<std::string> dropped = graph.keepOnly({"final", "indirect"});
    if (leftOut) *leftOut = dropped;
    return graph;
}

Value referenceGraph(const Experiment& experiment) {
    Value list = Value::list();
    list.where = experiment.reference.where;
    list.items.push_back(experiment.reference);
    return list;
}

std::vector<Variant> validateExperiment(const Experiment& experiment, const Registry& registry) {
    checkPassNames(experiment, registry);
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
