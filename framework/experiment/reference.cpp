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
constexpr int kReferenceVersion = 2;

struct Part {
    const char* name;  ///< Of the port and of the cached file.
    ReferenceLight ReferenceImages::*light;
    ImageF ReferenceLight::*half;
    ImageF& of(ReferenceImages& reference) const { return reference.*light.*half; }
    const ImageF& of(const ReferenceImages& reference) const { return reference.*light.*half; }
};
constexpr Part kParts[] = {{"final_a", &ReferenceImages::final, &ReferenceLight::a},
                           {"final_b", &ReferenceImages::final, &ReferenceLight::b},
                           {"indirect_a", &ReferenceImages::indirect, &ReferenceLight::a},
                           {"indirect_b", &ReferenceImages::indirect, &ReferenceLight::b}};

void setMeans(ReferenceImages& reference) {
    for (ReferenceLight* light : {&reference.final, &reference.indirect}) {
        light->mean = light->a;
        for (size_t i = 0; i < light->mean.data.size(); ++i)
            light->mean.data[i] = 0.5f * (light->a.data[i] + light->b.data[i]);
    }
}

bool isFinite(const ImageF& image) {
    for (const float value : image.data)
        if (!std::isfinite(value)) return false;
    return true;
}

}  // namespace

uint64_t referenceSeed(uint64_t seed) {
    static_assert(0x9e3779b97f4a7c15ull >> 63);
    return seed ^ 0x9e3779b97f4a7c15ull;
}

std::vector<std::string> referencePorts() {
    std::vector<std::string> names;
    for (const Part& part : kParts) names.emplace_back(part.name);
    return names;
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
        if (!image || !*image)
            throw Error("the reference wrote no '{}': path_trace needs 'spp: 2' or more and 'light: all'",
                        part.name);
        part.of(reference) = downloadImage(target.device, target.stream, *image);
    }
    setMeans(reference);
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
            part.of(reference) = std::move(image);
        }
        setMeans(reference);
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
            writeExr(temporary / (std::string(part.name) + ".exr"), part.of(reference));
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
