#include "experiment/parts.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "base/byte_units.h"
#include "base/interrupt.h"
#include "base/suggest.h"
#include "experiment/variant_run.h"

namespace voxray {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMerge = "merge";

/// The measured frames that need different references.
std::vector<uint32_t> referenceFrames(const PreparedExperiment& prepared, const Setup& setup) {
    if (prepared.experiment().reference.isNull()) return {};
    const MeasureSettings& measure = prepared.experiment().measure;
    std::vector<uint32_t> frames{0};
    if (measure.compareEvery > 0 && !isStatic(setup.scene))
        for (uint32_t i = 1; i < comparedFrames(measure); ++i) frames.push_back(i * measure.compareEvery);
    return frames;
}

std::vector<std::string> idsOf(const std::string& hash, uint32_t parts) {
    std::vector<std::string> ids;
    for (uint32_t i = 0; i < parts; ++i) ids.push_back(ReferenceParts::id(hash, {i, parts}));
    return ids;
}

/// Total number of parts in the id of a reference's part; 1 for other ids.
uint32_t partsIn(const std::string& id) {
    const size_t at = id.rfind('-');
    uint32_t parts = 1;
    if (id.starts_with("reference.") && at != id.npos)
        std::from_chars(id.data() + at + 1, id.data() + id.size(), parts);
    return std::max(parts, 1u);
}

/// Estimated memory and cost of a part.
struct PartNeed {
    uint64_t bytes = 0;
    uint64_t cost = 0;
    const char* unit = "";
    std::string error;  ///< Why it would fail.
};

PartNeed partNeedOf(const Part& part, PreparedExperiment& prepared, Forecaster& forecaster) {
    if (part.kind == Part::Kind::Merge) return {};
    Variant& variant = prepared.variants()[part.variant];
    if (part.kind == Part::Kind::Reference) {
        // Total and indirect light of two halves, in double
        const uint64_t pixels = uint64_t(variant.setup.image.width) * variant.setup.image.height;
        const uint64_t spp = referenceSamples(prepared.manifest().referencePass);
        return {
            pixels * 4 * 3 * sizeof(double), pixels * (part.samples.end(spp) - part.samples.first(spp)), "paths", {}};
    }
    const Forecast forecast = forecaster.forecast(variant);
    return {peakBytes(forecast.memory) + estimatedBytes(forecast.memory) + forecast.sceneBytes,
            graphRuns(prepared.experiment()), "runs of the graph", forecast.error};
}

const char* nameOf(Part::Kind kind) {
    return kind == Part::Kind::Reference ? "reference" : kind == Part::Kind::Variant ? "variant" : kMerge;
}

Json jobJson(const Part& part, const PartNeed& need) {
    Json job{{"id", part.id}, {"kind", nameOf(part.kind)}, {"after", part.after}, {"writes", part.writes}};
    if (!need.error.empty()) job["error"] = need.error;
    if (part.kind == Part::Kind::Merge || !need.error.empty()) return job;
    job["memory_bytes"] = need.bytes;
    job["cost"] = need.cost;
    job["cost_unit"] = need.unit;
    return job;
}

std::string jobLine(const Part& part, const PartNeed& need) {
    std::vector<std::string> details;
    if (!need.error.empty())
        details.push_back("would fail: " + need.error);
    else if (part.kind != Part::Kind::Merge)
        details.push_back(fmt::format("{:.1f} MiB, {} {}", double(need.bytes) / kMiB, need.cost, need.unit));
    if (part.after.size() == 1) details.push_back("after " + part.after[0]);
    if (part.after.size() > 1)
        details.push_back(fmt::format("after {} and {} more", part.after[0], part.after.size() - 1));
    return fmt::format("{}: {}\n", part.id, fmt::join(details, "; "));
}

void print(const Forecast& forecast) {
    if (!forecast.error.empty()) {
        fmt::print("  would fail: {}\n", forecast.error);
        return;
    }
    uint64_t persistent = 0;
    for (size_t i = 0; i < forecast.passes.size(); ++i) {
        const PassMemory& memory = forecast.memory[i];
        fmt::print("  {:24} {:6} {:10.1f} MiB", forecast.passes[i].id,
                   forecast.passes[i].phase == Phase::Build ? "build" : "frame", double(memory.bytes) / kMiB);
        if (memory.scratchBytes > 0) fmt::print(" and {:.1f} MiB of scratch", double(memory.scratchBytes) / kMiB);
        if (memory.estimatedBytes > 0)
            fmt::print(", about {:.1f} MiB more by the scene's size", double(memory.estimatedBytes) / kMiB);
        fmt::print("\n");
        persistent += memory.bytes + memory.estimatedBytes;
    }
    fmt::print("  {:24} {:6} {:10.1f} MiB, {:.1f} MiB with the largest scratch; the scene {:.1f} MiB\n", "sum", "",
               double(persistent) / kMiB, double(peakBytes(forecast.memory) + estimatedBytes(forecast.memory)) / kMiB,
               double(forecast.sceneBytes) / kMiB);
}

}  // namespace

std::vector<Part> partsOf(PreparedExperiment& prepared, uint32_t referenceParts) {
    if (!prepared.experiment().reference.isNull() &&
        referenceParts > referenceSamples(prepared.manifest().referencePass))
        throw UsageError(prepared.experiment().reference.where,
                         "reference.spp: {} samples a pixel can't be divided into {} parts",
                         referenceSamples(prepared.manifest().referencePass), referenceParts);
    std::vector<Part> references, variants;
    Part merge;
    std::set<std::string> listed;
    const auto& all = prepared.variants();
    for (size_t v = 0; v < all.size(); ++v) {
        Part variant;
        variant.kind = Part::Kind::Variant;
        variant.id = "variant." + all[v].id;
        variant.writes = "images/" + all[v].id + "/result.json";
        variant.variant = v;
        for (const uint32_t frame : referenceFrames(prepared, all[v].setup)) {
            const std::string hash = prepared.session().referenceHashOf(prepared.study(), all[v].setup, frame);
            const std::vector<std::string> ids = idsOf(hash, referenceParts);
            variant.after.insert(variant.after.end(), ids.begin(), ids.end());
            if (!listed.insert(hash).second) continue;
            for (uint32_t i = 0; i < referenceParts; ++i)
                references.push_back({Part::Kind::Reference,
                                      ids[i],
                                      {},
                                      std::string(ReferenceParts::kFolder) + "/" + ids[i] + ReferenceParts::kEnding,
                                      v,
                                      hash,
                                      frame,
                                      {i, referenceParts}});
        }
        merge.after.push_back(variant.id);
        variants.push_back(std::move(variant));
    }
    merge.id = kMerge;
    merge.writes = "results.csv";
    std::vector<Part> parts = std::move(references);
    parts.insert(parts.end(), variants.begin(), variants.end());
    parts.push_back(std::move(merge));
    return parts;
}

Part partNamed(PreparedExperiment& prepared, const std::string& id) {
    std::vector<std::string> ids;
    for (Part& part : partsOf(prepared, partsIn(id))) {
        if (part.id == id) return std::move(part);
        ids.push_back(part.id);
    }
    const std::string near = nearest(id, ids);
    throw UsageError("--part: this experiment has no part '{}'{}", id,
                     near.empty() ? "; './voxray jobs' lists them" : fmt::format("; did you mean '{}'?", near));
}

std::vector<std::string> missingBefore(const Part& part, PreparedExperiment& prepared) {
    std::vector<std::string> missing;
    if (part.kind != Part::Kind::Variant) return missing;
    const Setup& setup = prepared.variants()[part.variant].setup;
    for (const uint32_t frame : referenceFrames(prepared, setup)) {
        const std::string hash = prepared.session().referenceHashOf(prepared.study(), setup, frame);
        const std::string id = ReferenceParts::id(hash, {});
        if (!prepared.session().hasReference(hash)) missing.push_back(id.substr(0, id.rfind('.')));
    }
    return missing;
}

Forecast Forecaster::forecast(Variant& variant) {
    Session& session = prepared_.session();
    if (std::string key = session.loader().key(variant.setup.scene); key != sceneKey_) {
        scene_ = session.loader().prepare(variant.setup.scene, Origin::Scene);
        sceneBytes_ = gpuSceneBytes(scene_.state);
        sceneKey_ = std::move(key);
    }
    const Frame frame = frameOf(variant.setup, scene_, variant.setup.general.seed);
    Forecast forecast;
    try {
        forecast.memory = session.plan(variant.graph, frame, prepared_.experiment().measure.memoryLimitMb);
        forecast.passes = variant.graph.passes();
        forecast.sceneBytes = sceneBytes_;
    } catch (const Error& error) {
        forecast.error = error.what();
    }
    return forecast;
}

size_t printForecasts(PreparedExperiment& prepared) {
    const size_t count = prepared.variants().size();
    fmt::print("{}: {} variant{} on {}\n", prepared.experiment().setup.general.name, count, count == 1 ? "" : "s",
               prepared.session().device().info().name);
    size_t failed = 0;
    Forecaster forecaster(prepared);
    for (Variant& variant : prepared.variants()) {
        if (interruptRequested()) throw Interrupted();
        fmt::print("{} (tracer {}, {} x {})\n", variant.name, prepared.session().tracerName(variant.setup),
                   variant.setup.image.width, variant.setup.image.height);
        const Forecast forecast = forecaster.forecast(variant);
        print(forecast);
        failed += forecast.error.empty() ? 0 : 1;
    }
    fmt::print("What passes count on the device (voxels, surfels ...) is estimated, or counted while they run.\n");
    return failed;
}

std::string describeParts(PreparedExperiment& prepared, uint32_t referenceParts, bool asJson) {
    Json jobs = Json::array();
    std::string table;
    Forecaster forecaster(prepared);
    for (const Part& part : partsOf(prepared, referenceParts)) {
        if (interruptRequested()) throw Interrupted();
        const PartNeed need = partNeedOf(part, prepared, forecaster);
        jobs.push_back(jobJson(part, need));
        table += jobLine(part, need);
    }
    if (!asJson) return table;
    const Json all{{"experiment", prepared.experiment().setup.general.name}, {"jobs", std::move(jobs)}};
    return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace voxray
