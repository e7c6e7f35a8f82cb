#include "experiment/scoring.h"

#include <numeric>

#include "image/seed_error.h"
#include "image/temporal.h"

namespace voxray {
namespace {

constexpr const char* kTotal = kLightPrefixes[0];
constexpr const char* kIndirect = kLightPrefixes[1];

/// Calls body(suffix of columns, mask) for the whole image and for each mask that selects a pixel.
template <typename Body>
void forEachRegion(const std::vector<PixelSelection>& masks, const Body& body) {
    body(std::string(), PixelMask());
    for (const PixelSelection& mask : masks)
        if (mask.count > 0) body(maskSuffix(mask.name), PixelMask(mask.pixels));
}

void add(Scores& all, const std::string& light, const Scores& scores, const std::string& region) {
    for (const auto& [metric, value] : scores) all[light + metric + region] = value;
}

/// Mean of all pixels and channels.
double meanOf(const ImageF& image) {
    return std::accumulate(image.data.begin(), image.data.end(), 0.0) / double(image.data.size());
}

void addScores(Scores& all, const std::string& light, const Comparison& comparison,
               const std::vector<PixelSelection>& masks) {
    forEachRegion(masks,
                  [&](const std::string& region, PixelMask mask) { add(all, light, score(comparison, mask), region); });
}

}  // namespace

PreparedReference prepareReference(ReferenceImages images, std::vector<PixelSelection> masks,
                                   const ImageSettings& image, const std::string& folder) {
    PreparedReference reference{std::move(images), std::move(masks), {}};
    ReferenceRecord& r = reference.record;
    const ReferenceImages& ref = reference.images;
    r.folder = folder;
    r.hash = ref.hash;
    r.seconds = ref.seconds;
    r.cached = ref.cached;
    r.exposures = flipExposures(ref.final.mean);
    r.indirectExposures = flipExposures(ref.indirect.mean);
    for (const PixelSelection& mask : reference.masks)
        r.maskFractions[mask.name] = double(mask.count) / double(ref.final.mean.pixelCount());
    const auto addLight = [&](const std::string& prefix, const ReferenceLight& light, const FlipExposures& exposures) {
        const ScoreOptions options{image.exposureStops, exposures};
        const Comparison a(light.a, light.mean, options), b(light.b, light.mean, options);
        forEachRegion(reference.masks, [&](const std::string& region, PixelMask mask) {
            add(r.noise, prefix, noiseFloors(a, b, mask), region);
        });
    };
    addLight(kTotal, ref.final, r.exposures);
    addLight(kIndirect, ref.indirect, r.indirectExposures);
    return reference;
}

void addBaselines(PreparedReference& reference, const ImageSettings& image) {
    ReferenceRecord& r = reference.record;
    const auto addLight = [&](const std::string& prefix, const ReferenceLight& light, const FlipExposures& exposures) {
        const ScoreOptions options{image.exposureStops, exposures};
        const ImageF black = blackLike(light.mean), constant = constantLike(light.mean);
        addScores(r.black, prefix, {black, light.mean, options, light.halves()}, reference.masks);
        addScores(r.constant, prefix, {constant, light.mean, options, light.halves()}, reference.masks);
    };
    addLight(kTotal, reference.images.final, r.exposures);
    addLight(kIndirect, reference.images.indirect, r.indirectExposures);
}

ScoredFrame scoreFrame(const FrameImages& test, const ReferenceImages& reference,
                       const std::vector<PixelSelection>& masks, const ReferenceRecord& pinned, float exposureStops) {
    ScoredFrame scored;
    const auto addLight = [&](const std::string& light, const ImageF& image, const ReferenceLight& right,
                              const FlipExposures& exposures) {
        Comparison comparison(image, right.mean, {exposureStops, exposures}, right.halves());
        addScores(scored.scores, light, comparison, masks);
        return std::move(comparison.flip.map);
    };
    scored.flip = addLight(kTotal, test.final, reference.final, pinned.exposures);
    if (test.indirect)
        scored.indirectFlip = addLight(kIndirect, *test.indirect, reference.indirect, pinned.indirectExposures);
    return scored;
}

void scoreSeeds(const FrameImages& first, const FrameImages& second, const ReferenceImages& reference, Scores& scores) {
    add(scores, kTotal, seedScores(first.final, second.final, reference.final.halves()), "");
    if (first.indirect && second.indirect)
        add(scores, kIndirect, seedScores(*first.indirect, *second.indirect, reference.indirect.halves()), "");
}

void scoreAfterglow(std::span<const FrameMeans> means, uint32_t offAt, const std::string& light,
                    std::span<FrameScores> frames) {
    if (means.size() != frames.size()) throw Error("means of {} frames for {}", means.size(), frames.size());
    uint32_t lit = 0;
    double before = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].frame < offAt) {
            before = means[i].reference;
            continue;
        }
        const double lost = before - means[i].reference;
        if (!(lost > 0)) continue;
        const double afterglow = (means[i].test - means[i].reference) / lost;
        if (afterglow > kVisibleFraction) ++lit;
        frames[i].scores[light + "afterglow"] = afterglow;
        frames[i].scores[light + "frames_lit"] = lit;
    }
}

void scoreSequence(const std::vector<FrameImages>& frames, const PreparedReference& reference, const Scores& first,
                   const std::function<FrameReference(uint32_t)>& referenceOf, float exposureStops,
                   std::optional<uint32_t> lightOff, VariantResult& result) {
    TemporalError total, indirect;
    std::vector<FrameMeans> totalMeans, indirectMeans;
    for (const FrameImages& test : frames) {
        std::optional<FrameReference> frameReference;
        if (test.frame > 0 && referenceOf) frameReference = referenceOf(test.frame);
        const ReferenceImages& right = frameReference ? frameReference->images : reference.images;
        const auto& masks = frameReference ? frameReference->masks : reference.masks;
        result.frames.push_back({test.frame, first});
        if (test.frame > 0)
            result.frames.back().scores = scoreFrame(test, right, masks, reference.record, exposureStops).scores;
        total.add(test.final, right.final.halves());
        if (test.indirect) indirect.add(*test.indirect, right.indirect.halves());
        totalMeans.push_back({meanOf(test.final), meanOf(right.final.mean)});
        if (test.indirect) indirectMeans.push_back({meanOf(*test.indirect), meanOf(right.indirect.mean)});
    }
    if (lightOff) {
        scoreAfterglow(totalMeans, *lightOff, kTotal, result.frames);
        if (!indirectMeans.empty()) scoreAfterglow(indirectMeans, *lightOff, kIndirect, result.frames);
    }
    const auto addLight = [&](const std::string& light, const TemporalError& temporal) {
        add(result.scores, light, temporal.scores(), "");
        const std::vector<double> errors = temporal.frameErrors();
        for (size_t t = 0; t < errors.size(); ++t)
            result.frames[t + 1].scores[light + temporalMetrics()[0].name] = errors[t];
    };
    addLight(kTotal, total);
    addLight(kIndirect, indirect);
}

}  // namespace voxray
