#include "passes/final_gather/gather_screen_probes/screen_probes.h"

#include <algorithm>
#include <cmath>

#include "passes/common/compute/random_seed.h"

namespace voxray {

ScreenProbes::ScreenProbes(ProgramOwner& owner, const Settings& settings)
    : settings_(settings),
      place_(owner, "place_probes.comp", settings.keepsLast ? Defines{{"HAS_HISTORY", "1"}} : Defines{}),
      placeExtra_(owner, "place_probes.comp",
                  settings.keepsLast ? Defines{{"EXTRA", "1"}, {"HAS_HISTORY", "1"}} : Defines{{"EXTRA", "1"}}),
      list_(owner, "list_probes.comp"),
      sum_(owner, PrefixSum::Input::Uints) {}

void ScreenProbes::plan(PassPlan& plan, uint32_t samples) {
    const glm::uvec2 texels = gbufferExtent(plan.frame, samples);
    const uint32_t edge = settings_.spacing * samples;
    tiles_ = {texels, (texels + edge - 1u) / edge, edge};
    placeExtra_.compileIf(settings_.extraProbes > 0);
    const uint64_t starts = (uint64_t(tileCount()) + 1) * sizeof(uint32_t);
    plan.scratchBuffer(slots_, "slots of probes", uint64_t(capacity()) * sizeof(gpu::ScreenProbe));
    plan.scratchBuffer(counts_, "probes of tiles", starts);
    plan.scratchBuffer(extraCounts_, "probes of tiles with those added", starts);
    for (uint32_t frame = 0; frame < (settings_.keepsLast ? 2 : 1); ++frame) {
        plan.buffer(firstProbes_[frame], "first probes of tiles", starts);
    }
}

void ScreenProbes::place(PassContext& context, const GBuffer& gbuffer, const SurfaceMotion* motion) {
    hasLast_ = settings_.keepsLast && count_ > 0;
    current_ = settings_.keepsLast ? 1 - current_ : 0;
    CommandStream& stream = context.stream;
    const Frame& frame = context.frame;
    const float pixel = 2 * std::tan(0.5f * frame.camera.verticalFovRadians) / float(frame.height);
    const std::vector<Binding> history =
        motion ? std::vector<Binding>{{"previous", motion->previous}} : std::vector<Binding>{};
    const Bindings common{gbuffer,
                          history,
                          {"slots", slots_},
                          {"counts", counts_},
                          {"tiles", tiles_},
                          {"camera", frame.camera.position},
                          {"widthPerDistance", pixel * float(settings_.spacing)},
                          {"slotsPerTile", slotsPerTile()},
                          {"seed", randomSeed(frame) + 0x2fu},
                          {"frameIndex", context.frameIndex}};
    const bool addsExtra = settings_.extraProbes > 0;
    const Buffer& counts = addsExtra ? extraCounts_ : counts_;
    stream.fill(counts, 0);
    context.dispatch(place_, tileCount(), common);
    if (addsExtra) context.dispatch(placeExtra_, tileCount(), {common.all(), {"extraCounts", extraCounts_}});
    count_ = sum_.run(stream, counts, firstProbes_[current_], tileCount() + 1);
    growTo(probes_[current_], context.device, "screen probes", uint64_t(reservedCount()) * sizeof(gpu::ScreenProbe));
    context.dispatch(list_, tileCount(),
                     {{"slots", slots_},
                      {"firstProbes", firstProbes_[current_]},
                      {"probes", probes_[current_]},
                      {"count", tileCount()},
                      {"slotsPerTile", slotsPerTile()}});
}

uint32_t ScreenProbes::reservedCount() const {
    const uint32_t step = std::max(tileCount() / 4, 1u);
    return std::max((count_ + step - 1) / step, 1u) * step;
}

std::vector<Binding> ScreenProbes::bindings() const {
    std::vector<Binding> all{ifUsed({"probes", probes_[current_]}), ifUsed({"firstProbes", firstProbes_[current_]}),
                             ifUsed({"tiles", tiles_})};
    if (!settings_.keepsLast) return all;
    all.push_back(ifUsed({"oldProbes", hasLast_ ? probes_[1 - current_] : probes_[current_]}));
    all.push_back(ifUsed({"oldFirstProbes", firstProbes_[1 - current_]}));
    return all;
}

}  // namespace voxray
