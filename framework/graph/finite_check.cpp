#include "graph/finite_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint64_t kFloatsPerDispatch = 32768 * 64;  // A row of work groups.
constexpr size_t kMaxCounts = 256;                   // Until they are looked at.

/// Number of NaN or infinite floats, counted on the host.
uint32_t badFloatsOf(CommandStream& stream, const Buffer& buffer) {
    const std::vector<float> values = stream.readAs<float>(buffer, buffer.bytes() / sizeof(float));
    return uint32_t(std::ranges::count_if(values, [](float value) { return !std::isfinite(value); }));
}

}  // namespace

// In memory of the host, so that abandon() needs no command
FiniteCheck::FiniteCheck(Device& device)
    : counts_(device, "finite check", kMaxCounts * sizeof(uint32_t), MemoryKind::Readback) {}

void FiniteCheck::add(CommandStream& stream, Checked checked) {
    if (checked_.size() == kMaxCounts) finish(stream);
    counts_.mappedAs<uint32_t>()[checked_.size()] = checked.bad;
    checked_.push_back(std::move(checked));
}

void FiniteCheck::count(CommandStream& stream, const Image& image, std::string what) {
    const glm::uvec3 extent = image.desc().extent;
    if (stream.device().isHost()) {
        if (image.desc().format != VK_FORMAT_R32G32B32A32_SFLOAT)
            throw Error("image '{}' is not RGBA32F and can't be checked on the host", image.name());
        const Buffer texels(stream.device(), "finite check", imageBytes(image.desc()));
        stream.copy(image, texels);
        add(stream, {std::move(what), image.name(), "texels", badFloatsOf(stream, texels)});
        return;
    }
    add(stream, {std::move(what), image.name(), "texels", 0});
    stream.dispatch(extent.z > 1 ? image3d_ : image2d_, extent,
                    {{"image", image}, {"counts", counts_}, {"slot", uint32_t(checked_.size() - 1)}});
}

void FiniteCheck::count(CommandStream& stream, const Buffer& buffer, std::string what) {
    if (stream.device().isHost()) {
        add(stream, {std::move(what), buffer.name(), "values", badFloatsOf(stream, buffer)});
        return;
    }
    add(stream, {std::move(what), buffer.name(), "values", 0});
    const uint64_t total = buffer.bytes() / sizeof(float);
    for (uint64_t first = 0; first < total; first += kFloatsPerDispatch) {
        const uint64_t floats = std::min(total - first, kFloatsPerDispatch);
        stream.dispatch(buffer_, floats,
                        {{"words", buffer.address() + first * sizeof(float)},
                         {"floatCount", floats},
                         {"counts", counts_},
                         {"slot", uint32_t(checked_.size() - 1)}});
    }
}

void FiniteCheck::finish(CommandStream& stream) {
    if (checked_.empty()) return;
    stream.finish();
    abandon();
}

void FiniteCheck::abandon() {
    const std::vector<Checked> checked = std::exchange(checked_, {});
    for (size_t i = 0; i < checked.size(); ++i)
        if (const uint32_t bad = counts_.mappedAs<uint32_t>()[i])
            throw Error("{} ({}, {} {})", checked[i].what, checked[i].resource, bad, checked[i].unit);
}

}  // namespace voxray
