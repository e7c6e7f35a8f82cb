#include "experiment/reference.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/files.h"
#include "base/interrupt.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

/// Raise it when the reference's meaning changes: older caches are then left alone.
constexpr int kReferenceVersion = 1;

struct Part {
    const char* name;  ///< Of the port and of the cached file.
    ImageF ReferenceImages::*member;
};
constexpr Part kParts[] = {{"final", &ReferenceImages::final},
                           {"indirect", &ReferenceImages::indirect},
                           {"variance", &ReferenceImages::variance},
                           {"indirect_variance", &ReferenceImages::indirectVariance}};

bool isFinite(const ImageF& image) {
    for (const float value : image.data)
        if (!std::isfinite(value)) return false;
    return true;
}

}  // namespace

Scores noiseFloor(const ImageF& mean, const ImageF& variance, PixelMask mask) {
    // As the metrics do, in units of the reference's mean
    const double scale = meanValue(mean, mask);
    if (!(scale > 0)) return {};
    double squares = 0, relative = 0;
    for (size_t i = 0; i < mean.data.size(); ++i) {
        if (!mask.empty() && !mask[i / mean.channels]) continue;
        const double r = mean.data[i] / scale, v = variance.data[i] / (scale * scale);
        squares += v;
        relative += v / (r * r + 0.01);
    }
    const double count = double(countPixels(mean, mask) * mean.channels);
    return {{"nrmse", std::sqrt(squares / count)}, {"relmse", relative / count}};
}

uint64_t referenceSeed(uint64_t seed) {
    return seed ^ 0x9e3779b97f4a7c15ull;
}

ReferenceImages renderReference(Graph& graph, const GraphTarget& target, uint32_t frameIndex,
                                const std::function<void(double)>& progress) {
    Frame frame = target.frame;
    frame.progress = [&](double part) {
        progress(part);
        return !interruptRequested();
    };
    const auto start = std::chrono::steady_clock::now();
    for (const Phase phase : {Phase::Build, Phase::Frame}) {
        graph.run(phase, frame, target.device, target.stream, target.tracer, target.scene, frameIndex, true);
        if (interruptRequested()) throw Interrupted();
    }
    ReferenceImages reference;
    reference.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (const Part& part : kParts) {
        const Image* image = graph.image(part.name);
        if (!image || !*image) throw Error("the reference wrote no '{}'", part.name);
        reference.*(part.member) = downloadImage(target.device, target.stream, *image);
    }
    return reference;
}

std::string referenceHash(const std::string& sceneKey, const Value& resolvedPass, const ImageSettings& image,
                          uint64_t seed) {
    Hasher hasher;
    hasher.addPlain(kReferenceVersion).add(sceneKey).add(resolvedPass.text());
    return hasher.addPlain(image.width).addPlain(image.height).addPlain(seed).hex();
}

std::optional<ReferenceImages> ReferenceCache::load(const std::string& hash, uint32_t width,
                                                    uint32_t height) const {
    const fs::path folder = folder_ / hash;
    std::error_code code;
    if (!fs::exists(folder / "reference.json", code)) return {};
    try {
        ReferenceImages reference;
        reference.hash = hash;
        reference.cached = true;
        for (const Part& part : kParts) {
            ImageF image = readImage(folder / (std::string(part.name) + ".exr"));
            if (image.width != width || image.height != height || image.channels != 3 || !isFinite(image))
                return {};
            reference.*(part.member) = std::move(image);
        }
        reference.seconds =
            nlohmann::json::parse(readTextFile(folder / "reference.json")).at("seconds").get<double>();
        return reference;
    } catch (const std::exception&) {
        // A damaged cache costs time, not results
        return {};
    }
}

void ReferenceCache::store(const ReferenceImages& reference) const {
    const fs::path folder = folder_ / reference.hash;
    const fs::path temporary = folder_ / (".tmp-" + reference.hash + "-" + std::to_string(::getpid()));
    std::error_code ignored;
    try {
        fs::remove_all(temporary);
        fs::create_directories(temporary);
        for (const Part& part : kParts)
            writeExr(temporary / (std::string(part.name) + ".exr"), reference.*(part.member));
        const nlohmann::json meta{{"seconds", reference.seconds}};
        writeFileAtomically(temporary / "reference.json", meta.dump(1) + "\n");
        fs::remove_all(folder);
        fs::rename(temporary, folder);
    } catch (const fs::filesystem_error& error) {
        fs::remove_all(temporary, ignored);
        throw Error("{}: {}", folder.string(), error.code().message());
    } catch (...) {
        fs::remove_all(temporary, ignored);
        throw;
    }
}

}  // namespace voxray
