#include "experiment/reference_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "base/files.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

constexpr size_t kDigits = 32;  ///< Of the hash of what follows it.

template <typename Sums>
auto halvesOf(Sums& sums) {
    return std::array{&sums.final[0], &sums.final[1], &sums.indirect[0], &sums.indirect[1]};
}

/// A hash, a line of JSON, then the sums: final of both halves, indirect of both halves.
std::string contentOf(const std::string& hash, const RenderedPart& rendered) {
    const ReferenceSums& sums = rendered.sums;
    const nlohmann::json head{{"hash", hash},
                              {"width", sums.final[0].width},
                              {"height", sums.final[0].height},
                              {"samples", {sums.final[0].samples, sums.final[1].samples}},
                              {"seconds", rendered.seconds},
                              {"whole", rendered.isWhole}};
    std::string body = head.dump() + "\n";
    for (const SampleSums* half : halvesOf(sums))
        body.append(reinterpret_cast<const char*>(half->data.data()), half->data.size() * sizeof(double));
    return Hasher().add(body.data(), body.size()).hex() + body;
}

/// @throws std::exception where the file isn't as contentOf() made it.
RenderedPart readPart(const fs::path& file, const std::string& hash, uint32_t width, uint32_t height) {
    const std::string text = readTextFile(file);
    const std::string_view content = text, body = content.substr(std::min(kDigits, content.size()));
    if (Hasher().add(body.data(), body.size()).hex() != content.substr(0, kDigits))
        throw Error("it is damaged");
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
    size_t number = 0;
    for (SampleSums* half : halvesOf(rendered.sums)) {
        *half = SampleSums(width, height, head.at("samples").at(number++ % 2).get<uint64_t>());
        std::memcpy(half->data.data(), from, bytes);
        from += bytes;
    }
    return rendered;
}

/// Reads "2-of-16"; 0 parts where it is something else.
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

void ReferenceParts::store(const std::string& hash, const SamplePart& part,
                           const RenderedPart& rendered) const {
    writeFileAtomically(file(hash, part), contentOf(hash, rendered));
}

uint32_t ReferenceParts::division(const std::string& hash) const {
    std::error_code code;
    std::map<uint32_t, uint32_t> found;  // Parts of each division.
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
    const uint32_t parts = division(hash);
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
