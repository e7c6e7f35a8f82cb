#include "experiment/forecast.h"

#include "base/byte_units.h"
#include "base/interrupt.h"

namespace voxray {
namespace {

void print(const Forecast& forecast) {
    if (!forecast.error.empty()) {
        fmt::print("  would fail: {}\n", forecast.error);
        return;
    }
    uint64_t kept = 0;
    for (size_t i = 0; i < forecast.passes.size(); ++i) {
        const PassMemory& memory = forecast.memory[i];
        fmt::print("  {:24} {:6} {:10.1f} MiB", forecast.passes[i].id,
                   forecast.passes[i].phase == Phase::Build ? "build" : "frame", double(memory.bytes) / kMiB);
        if (memory.scratchBytes > 0)
            fmt::print(" and {:.1f} MiB of scratch", double(memory.scratchBytes) / kMiB);
        if (memory.estimatedBytes > 0)
            fmt::print(", about {:.1f} MiB more by the scene's size", double(memory.estimatedBytes) / kMiB);
        fmt::print("\n");
        kept += memory.bytes + memory.estimatedBytes;
    }
    fmt::print("  {:24} {:6} {:10.1f} MiB, {:.1f} MiB with the largest scratch; the scene {:.1f} MiB\n",
               "sum", "", double(kept) / kMiB,
               double(peakBytes(forecast.memory) + estimatedBytes(forecast.memory)) / kMiB,
               double(forecast.sceneBytes) / kMiB);
}

}  // namespace

Forecast Forecaster::forecast(Variant& variant) {
    Session& session = prepared_.session();
    if (std::string key = session.loader().key(variant.setup.scene); key != sceneKey_) {
        scene_ = session.loader().prepare(variant.setup.scene, Origin::Scene);
        sceneBytes_ = gpuSceneBytes(scene_.state);
        sceneKey_ = std::move(key);
    }
    const Frame frame = frameOf(variant.setup, scene_, variant.setup.general.seed);
    Forecast own;
    try {
        own.memory = session.plan(variant.graph, frame, prepared_.experiment().measure.memoryLimitMb);
        own.passes = variant.graph.passes();
        own.sceneBytes = sceneBytes_;
    } catch (const Error& error) {
        own.error = error.what();
    }
    return own;
}

size_t printForecasts(PreparedExperiment& prepared) {
    const size_t count = prepared.variants().size();
    fmt::print("{}: {} variant{} on {}\n", prepared.experiment().setup.general.name, count,
               count == 1 ? "" : "s", prepared.session().device().info().name);
    size_t failed = 0;
    Forecaster forecaster(prepared);
    for (Variant& variant : prepared.variants()) {
        if (interruptRequested()) throw Interrupted();
        fmt::print("{} (tracer {}, {} x {})\n", variant.name, prepared.session().tracerName(variant.setup),
                   variant.setup.image.width, variant.setup.image.height);
        const Forecast own = forecaster.forecast(variant);
        print(own);
        failed += own.error.empty() ? 0 : 1;
    }
    fmt::print(
        "What passes count on the device (voxels, surfels ...) is estimated, or counted while they run.\n");
    return failed;
}

}  // namespace voxray
