#include "experiment/reference.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/files.h"
#include "base/interrupt.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

/// Part of the hash. It must be increased whenever references change, so that older caches are not used.
constexpr int kReferenceVersion = 4;

/// Access to total or indirect light of one half of the samples.
struct Half {
    const char* name;  ///< Name of the cached file.
    ReferenceLight ReferenceImages::*light;
    ImageF ReferenceLight::*half;
    std::array<SampleSums, 2> ReferenceSums::*lightSums;
    size_t number;
    ImageF& of(ReferenceImages& reference) const { return reference.*light.*half; }
    const ImageF& of(const ReferenceImages& reference) const { return reference.*light.*half; }
    SampleSums& of(ReferenceSums& sums) const { return (sums.*lightSums)[number]; }
    const SampleSums& of(const ReferenceSums& sums) const { return (sums.*lightSums)[number]; }
};
constexpr Half kHalves[] = {
    {"final_a", &ReferenceImages::final, &ReferenceLight::a, &ReferenceSums::final, 0},
    {"final_b", &ReferenceImages::final, &ReferenceLight::b, &ReferenceSums::final, 1},
    {"indirect_a", &ReferenceImages::indirect, &ReferenceLight::a, &ReferenceSums::indirect, 0},
    {"indirect_b", &ReferenceImages::indirect, &ReferenceLight::b, &ReferenceSums::indirect, 1}};

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

constexpr size_t kDigits = 32;  ///< Length of the hash.

/// Contents of a file: a hash of what follows, a line of JSON, then the sums in the order of kHalves.
std::string contentOf(const std::string& hash, const RenderedPart& rendered) {
    const ReferenceSums& sums = rendered.sums;
    const nlohmann::json head{{"hash", hash},
                              {"width", sums.final[0].width},
                              {"height", sums.final[0].height},
                              {"samples", {sums.final[0].samples, sums.final[1].samples}},
                              {"seconds", rendered.seconds},
                              {"whole", rendered.isWhole}};
    std::string body = head.dump() + "\n";
    for (const Half& half : kHalves) {
        const std::vector<double>& data = half.of(sums).data;
        body.append(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(double));
    }
    return Hasher().add(body.data(), body.size()).hex() + body;
}

/// @throws std::exception if the file wasn't written by contentOf() for this reference.
RenderedPart readPart(const fs::path& file, const std::string& hash, uint32_t width, uint32_t height) {
    const std::string text = readTextFile(file);
    const std::string_view content = text, body = content.substr(std::min(kDigits, content.size()));
    if (Hasher().add(body.data(), body.size()).hex() != content.substr(0, kDigits)) throw Error("it is damaged");
    const size_t line = body.find('\n');
    const auto head = nlohmann::json::parse(body.substr(0, line));
    if (head.at("hash").get<std::string>() != hash || head.at("width").get<uint32_t>() != width ||
        head.at("height").get<uint32_t>() != height)
        throw Error("it is of another reference");
    RenderedPart rendered;
    rendered.seconds = head.at("seconds").get<double>();
    rendered.isWhole = head.at("whole").get<bool>();
    const char* from = body.data() + line + 1;
    const size_t bytes = size_t(width) * height * 3 * sizeof(double);
    if (body.size() != line + 1 + 4 * bytes) throw Error("it is damaged");
    for (const Half& half : kHalves) {
        SampleSums& sums = half.of(rendered.sums);
        sums = SampleSums(width, height, head.at("samples").at(half.number).get<uint64_t>());
        std::memcpy(sums.data.data(), from, bytes);
        from += bytes;
    }
    return rendered;
}

/// Parses "2-of-16". For other texts the number of parts is 0.
SamplePart partFrom(std::string_view text) {
    constexpr std::string_view kOf = "-of-";
    const size_t at = text.find(kOf);
    if (at == text.npos) return {0, 0};
    uint32_t number = 0, parts = 0;
    std::from_chars(text.data(), text.data() + at, number);
    std::from_chars(text.data() + at + kOf.size(), text.data() + text.size(), parts);
    return number >= 1 && number <= parts ? SamplePart{number - 1, parts} : SamplePart{0, 0};
}

}  // namespace

uint64_t referenceSeed(uint64_t seed) {
    static_assert(0x9e3779b97f4a7c15ull >> 63);
    return seed ^ 0x9e3779b97f4a7c15ull;
}

std::vector<std::string> referencePorts() {
    return {"sums"};
}

uint32_t referenceSamples(const Value& resolvedPass) {
    const Value* spp = resolvedPass.find("spp");
    return spp ? uint32_t(spp->asInteger("reference.spp")) : 1;
}

RenderedPart renderReference(Graph& graph, const GraphTarget& target, uint32_t frameIndex,
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
    const auto* sums = graph.resource<ReferenceSums>("sums");
    if (!sums || sums->final[0].data.empty())
        throw Error("the reference wrote no 'sums': path_trace needs 'spp: 2' or more and 'light: all'");
    return {*sums, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

void RenderedPart::add(const RenderedPart& other) {
    seconds += other.seconds;
    for (const Half& half : kHalves) half.of(sums).add(half.of(other.sums));
}

ReferenceImages imagesOf(const RenderedPart& whole) {
    ReferenceImages reference;
    reference.seconds = whole.seconds;
    for (const Half& half : kHalves) {
        const SampleSums& sum = half.of(whole.sums);
        if (sum.samples == 0) throw Error("the reference has no sample in its half '{}'", half.name);
        half.of(reference) = sum.mean();
    }
    setMeans(reference);
    return reference;
}

RenderedPart partOf(const ReferenceImages& reference) {
    RenderedPart part;
    part.seconds = reference.seconds;
    part.isWhole = true;
    for (const Half& half : kHalves) {
        const ImageF& image = half.of(reference);
        SampleSums& sums = half.of(part.sums) = SampleSums(image.width, image.height, 1);
        std::ranges::copy(image.data, sums.data.begin());
    }
    return part;
}

std::string referenceHash(const std::string& sceneKey, const Value& resolvedPass, const ImageSettings& image,
                          uint64_t seed) {
    Hasher hasher;
    hasher.addPlain(kReferenceVersion).add(sceneKey).add(resolvedPass.text());
    return hasher.addPlain(image.width).addPlain(image.height).addPlain(seed).hex();
}

bool ReferenceCache::has(const std::string& hash) const {
    std::error_code code;
    return fs::exists(folder_ / hash / "reference.json", code);
}

std::optional<ReferenceImages> ReferenceCache::load(const std::string& hash, uint32_t width, uint32_t height) const {
    if (!has(hash)) return {};
    const fs::path folder = folder_ / hash;
    try {
        ReferenceImages reference;
        reference.hash = hash;
        reference.cached = true;
        for (const Half& half : kHalves) {
            ImageF image = readImage(folder / (std::string(half.name) + ".exr"));
            if (image.width != width || image.height != height || image.channels != 3 || !isFinite(image)) return {};
            half.of(reference) = std::move(image);
        }
        setMeans(reference);
        reference.seconds = nlohmann::json::parse(readTextFile(folder / "reference.json")).at("seconds").get<double>();
        return reference;
    } catch (const std::exception&) {
        // A damaged reference is rendered again
        return {};
    }
}

void ReferenceCache::store(const ReferenceImages& reference) const {
    // Another process may have stored it; a damaged one is replaced
    const ImageF& image = reference.final.mean;
    if (load(reference.hash, image.width, image.height)) return;
    const fs::path folder = folder_ / reference.hash;
    try {
        writeFolderAtomically(folder, [&](const fs::path& temporary) {
            for (const Half& half : kHalves)
                writeExr(temporary / (std::string(half.name) + ".exr"), half.of(reference));
            const nlohmann::json meta{{"seconds", reference.seconds}};
            writeFileAtomically(temporary / "reference.json", meta.dump(1) + "\n");
        });
    } catch (const fs::filesystem_error& error) {
        throw Error("{}: {}", folder.string(), error.code().message());
    }
}

std::string ReferenceParts::id(const std::string& hash, const SamplePart& part) {
    return fmt::format("reference.{}.{}-of-{}", hash.substr(0, 12), part.index + 1, part.parts);
}

fs::path ReferenceParts::file(const std::string& hash, const SamplePart& part) const {
    return folder_ / (id(hash, part) + kEnding);
}

bool ReferenceParts::has(const std::string& hash, const SamplePart& part) const {
    std::error_code code;
    return fs::exists(file(hash, part), code);
}

void ReferenceParts::store(const std::string& hash, const SamplePart& part, const RenderedPart& rendered) const {
    writeFileAtomically(file(hash, part), contentOf(hash, rendered));
}

uint32_t ReferenceParts::completeParts(const std::string& hash) const {
    std::error_code code;
    std::map<uint32_t, uint32_t> found;  // Number of existing parts by the total number of parts.
    for (const auto& entry : fs::directory_iterator(folder_, code)) {
        if (entry.path().extension() != kEnding) continue;
        const std::string name = entry.path().stem().string();
        const SamplePart part = partFrom(std::string_view(name).substr(name.rfind('.') + 1));
        if (part.parts > 0 && name == id(hash, part)) ++found[part.parts];
    }
    for (const auto& [parts, count] : found)
        if (parts == count) return parts;
    return 0;
}

RenderedPart ReferenceParts::load(const std::string& hash, uint32_t width, uint32_t height) const {
    const uint32_t parts = completeParts(hash);
    RenderedPart sum;
    for (uint32_t i = 0; i < parts; ++i) {
        const fs::path path = file(hash, {i, parts});
        try {
            RenderedPart part = readPart(path, hash, width, height);
            if (part.isWhole) return part;
            if (i == 0)
                sum = std::move(part);
            else
                sum.add(part);
        } catch (const std::exception& error) {
            throw Error("{}: {}; render this part again", path.string(), error.what());
        }
    }
    return sum;
}

}  // namespace voxray
