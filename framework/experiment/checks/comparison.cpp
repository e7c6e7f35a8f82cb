#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "config/overrides.h"
#include "experiment/checks/checks.h"

namespace voxray {
namespace {

/// The first pass of a variant with a parameter `bounces`, and the location of the parameter in the config.
struct Bounces {
    std::string id;
    TextLocation where;
    int64_t value;
};
std::optional<Bounces> bouncesOf(const Variant& variant) {
    for (const Value& pass : variant.resolved.items)
        if (const Value* bounces = pass.find("bounces"))
            for (const Value& entry : variant.setup.graph.items)
                if (passId(entry) == passId(pass)) {
                    const Value* written = entry.find("bounces");
                    return Bounces{passId(pass), written ? written->where : entry.where, bounces->asInteger("bounces")};
                }
    return std::nullopt;
}

}  // namespace

/// Warns of temporal passes with too few warm-up frames if only frame 0 is compared.
void shortHistory(const PlannedVariant& v, Diagnostics& found) {
    const MeasureSettings& measure = v.study.experiment.measure;
    if (measure.compareEvery > 0) return;
    for (const Graph::PassInfo& pass : v.variant.graph.passes())
        if (pass.warmupFrames > measure.warmup)
            found.push_back(
                {pass.where,
                 fmt::format("{}: it goes on from frame to frame, "
                             "and {} of the {} frames that it looks back on come before the one that is compared:",
                             pass.id, measure.warmup, pass.warmupFrames),
                 fmt::format("write measure: {{warmup: {}}}, or compare a sequence with 'compare_every'",
                             pass.warmupFrames)});
}

/// Warns of an image without direct or indirect light, which the reference has.
void missingLight(const PlannedVariant& v, Diagnostics& found) {
    if (!v.reference) return;
    const auto* indirect = v.reference->resource<FrameImage>(kIndirectImage);
    const bool isDirectOnly = indirect && indirect->lightBounces == 0u;
    for (const Graph::Input& input : v.variant.graph.unboundInputs(kComparedImage))
        if (std::ranges::count(kPartsOfLight, input.port) > 0 && !(isDirectOnly && input.port == kIndirectImage))
            found.push_back(
                {input.where,
                 fmt::format("{0}: "
                             "no pass before it writes '{1}', so that '{2}' lacks {1} light, which the reference has",
                             input.id, input.port, kComparedImage),
                 fmt::format("these can: {}", fmt::join(v.study.registry->writersOf(input.port), ", "))});
}

/// Warns of another number of bounces than the reference has, which is an error that no other parameter
/// reduces; unless the sweep varies it.
void differentBounces(const PlannedVariant& v, Diagnostics& found) {
    if (!v.reference) return;
    const auto* test = v.variant.graph.resource<FrameImage>(kIndirectImage);
    const auto* expected = v.reference->resource<FrameImage>(kIndirectImage);
    const auto variesBounces = [](const auto& axis) { return axis.key.ends_with(".bounces"); };
    if (std::ranges::any_of(v.study.experiment.sweep.members, variesBounces)) return;
    if (!test || !expected || !test->lightBounces || !expected->lightBounces ||
        *test->lightBounces == *expected->lightBounces)
        return;
    const int64_t has = *test->lightBounces, wanted = *expected->lightBounces;
    std::string advice = fmt::format("write 'bounces: {}' in the reference", has);

    // Later passes may add bounces
    const std::optional<Bounces> first = bouncesOf(v.variant);
    if (first && has >= first->value && first->value + wanted - has >= 0)
        advice =
            fmt::format("write 'bounces: {}' in '{}', or {}", first->value + wanted - has, first->id, advice.substr(6));
    found.push_back({first ? first->where : v.study.experiment.reference.where,
                     fmt::format("indirect light has {} bounces, the reference's {}:", has, wanted), advice});
}

/// Warns of a variant without specular lobes if much of the view is metal.
void missingLobes(const PlannedVariant& v, Diagnostics& found) {
    constexpr double kMinMetallicFraction = 0.1;
    if (!v.reference || v.visibleMetalFraction < kMinMetallicFraction) return;
    const auto* test = v.variant.graph.resource<FrameImage>(kIndirectImage);
    const auto* expected = v.reference->resource<FrameImage>(kIndirectImage);
    if (!test || !expected || test->hasSpecularLobes || !expected->hasSpecularLobes) return;
    found.push_back(
        {v.variant.setup.scene.where,
         fmt::format("scene: {:.0f} % of the surfaces in view are metal, which reflects by specular lobes alone: "
                     "the reference has what they reflect of indirect light, and this variant lacks it",
                     100 * v.visibleMetalFraction),
         "write 'materials: "
         "lambert' for a scene without lobes, or take gather_mirror, or gather_cones with 'specular'"});
}

/// Warns of a reference whose halves have different numbers of samples.
void unequalHalves(const Study& study, Diagnostics& found) {
    const Value* spp = study.experiment.reference.find("spp");
    if (!spp) return;
    const int64_t samples = spp->asInteger("reference.spp");
    if (samples % 2 == 0) return;
    found.push_back({spp->where,
                     fmt::format("reference.spp: of {} samples a pixel one half of the reference has {}, "
                                 "the other {}, and both count the same:",
                                 samples, samples / 2, samples - samples / 2),
                     "write an even number, best a power of two"});
}

}  // namespace voxray
