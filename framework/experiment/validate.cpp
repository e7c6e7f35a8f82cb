#include "experiment/validate.h"

#include <limits>

#include "config/overrides.h"
#include "experiment/reference.h"
#include "experiment/session.h"

namespace voxray {
namespace {

void checkPassName(const Value& pass, const Registry& registry) {
    for (const Value& item : pass.items) checkPassName(item, registry);  // A chain.
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

Graph referenceGraph(const Experiment& experiment, const Registry& registry) {
    Value list = Value::list();
    list.where = experiment.reference.where;
    list.items.push_back(experiment.reference);
    Graph graph(registry, list);
    graph.keepOnly(referencePorts());
    return graph;
}

WiredExperiment wireExperiment(Experiment experiment, const Registry& registry) {
    checkPassNames(experiment, registry);
    WiredExperiment wired;
    for (Variant& variant : expandSweep(experiment)) {
        Graph graph(registry, variant.setup.graph);
        if (!graph.writes("final"))
            throw UsageError(variant.setup.graph.where,
                             "graph: no pass writes 'final', the image that is compared");
        std::vector<std::string> leftOut = graph.keepOnly({"final", "indirect"});
        Value resolved = graph.resolved();
        wired.variants.push_back(
            {std::move(variant), std::move(graph), std::move(resolved), std::move(leftOut)});
    }
    if (!experiment.reference.isNull()) {
        const Graph graph = referenceGraph(experiment, registry);
        for (const std::string& port : referencePorts())
            if (!graph.writes(port))
                throw UsageError(experiment.reference.where,
                                 "reference: the pass writes no '{}'; use path_trace", port);
        wired.reference = graph.resolved();
        // Of a single sample there are no halves, which tell the reference's noise
        if (const Value* spp = experiment.reference.find("spp"); spp && spp->asInteger("reference.spp") < 2)
            throw UsageError(spp->where,
                             "reference.spp: 2 or more; from its halves comes the reference's noise");
    }
    wired.experiment = std::move(experiment);
    return wired;
}

void checkPlans(WiredExperiment& wired, SceneLoader& loader, const DeviceInfo& device,
                const Registry& registry) {
    constexpr uint64_t kAnySize = std::numeric_limits<uint64_t>::max();
    std::string key;
    PreparedScene prepared;
    for (WiredVariant& variant : wired.variants) {
        // Variants in a row mostly share a scene
        if (std::string own = loader.key(variant.setup.scene); own != key) {
            prepared = loader.prepare(variant.setup.scene);
            key = std::move(own);
        }
        const Frame frame = frameOf(variant.setup, prepared, variant.setup.general.seed);
        try {
            variant.graph.plan(frame, device, kAnySize);
            if (!wired.reference.isNull())
                referenceGraph(wired.experiment, registry).plan(frame, device, kAnySize);
        } catch (const Error& error) {
            throw UsageError("{}{}", error.what(),
                             wired.variants.size() > 1 ? fmt::format(" (variant {})", variant.name) : "");
        }
    }
}

}  // namespace voxray
