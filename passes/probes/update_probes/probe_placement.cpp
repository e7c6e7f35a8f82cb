#include "passes/probes/update_probes/probe_placement.h"

namespace voxray {
namespace {

/// Largest offset along an axis, in spacings: probes stay in their cells. As in the authors' library.
constexpr float kReach = 0.45f;

}  // namespace

ProbePlacement::ProbePlacement(ProgramOwner& owner)
    : reset_(owner, "reset_probes.comp"),
      relocate_(owner, "relocate_probes.comp"),
      classify_(owner, "classify_probes.comp") {}

void ProbePlacement::plan(const Settings& settings) {
    settings_ = settings;
    for (Kernel* kernel : {&relocate_, &classify_}) kernel->specialize({{"kBacksAreDark", settings.backsAreDark}});
    relocate_.compileIf(settings.relocationSteps > 0);
    classify_.compileIf(settings.classifies);
}

void ProbePlacement::place(PassContext& context, const Probes& probes, ProbeRays& rays,
                           const std::vector<uint32_t>& list) {
    const std::vector<Binding> places = probes.bindings();
    rays.setList(context.stream, list);
    context.dispatch(reset_, list.size(), {places, rays.bindings(), {"count", uint32_t(list.size())}});
    for (uint32_t step = 0; step < settings_.relocationSteps; ++step)
        rays.trace(context, probes, 0, [&](const ProbeBatch& batch) {
            context.dispatch(relocate_, batch.count,
                             {context.scene,
                              places,
                              rays.bindings(),
                              {"first", batch.first},
                              {"count", batch.count},
                              {"backfaceThreshold", settings_.backfaceThreshold},
                              {"minDistance", settings_.minDistance},
                              {"reach", kReach}});
        });
    if (settings_.classifies)
        rays.trace(context, probes, 0, [&](const ProbeBatch& batch) {
            context.dispatch(classify_, batch.count,
                             {context.scene,
                              places,
                              rays.bindings(),
                              {"first", batch.first},
                              {"count", batch.count},
                              {"backfaceThreshold", settings_.backfaceThreshold}});
        });

    const auto states =
        context.stream.readAs<gpu::ProbeState>(probes.states, probes.states.bytes() / sizeof(gpu::ProbeState));
    active_.clear();
    probes_ = uint32_t(states.size());
    inSurfaces_ = 0;
    for (uint32_t i = 0; i < probes_; ++i) {
        if (states[i].status == PROBE_ON) active_.push_back(i);
        if (states[i].status == PROBE_IN_SURFACES) ++inSurfaces_;
    }
}

void ProbePlacement::report(PassContext& context) const {
    context.report("probes", probes_);
    context.report("probes that are on, %", 100.0 * double(active_.size()) / probes_);
    context.report("probes in surfaces, %", 100.0 * inSurfaces_ / probes_);
}

}  // namespace voxray
