#include "passes/radiosity/link_surfels/waiting_links.h"

#include <algorithm>
#include <numeric>

namespace voxray {
namespace {

constexpr uint32_t kGroups = 64;  ///< LINK_GROUPS of waiting_links.glsl.

}  // namespace

WaitingLinks::WaitingLinks(ProgramOwner& owner)
    : count_(owner, "count_waiting_links.comp"), list_(owner, "list_waiting_links.comp") {}

double WaitingLinks::plan(PassPlan& plan, uint32_t raysPerSurfel) {
    raysPerSurfel_ = raysPerSurfel;
    plan.buffer(classCounts_, "waiting links of classes", uint64_t(raysPerSurfel) * kGroups * sizeof(uint32_t));
    plan.buffer(selected_, "selected classes of links", uint64_t(wordsPerSurfel()) * kGroups * sizeof(uint32_t));
    return double(wordsPerSurfel() * sizeof(uint32_t));
}

void WaitingLinks::clear(PassContext& context, uint32_t surfels) {
    surfels_ = surfels;
    ensureSize(bits_, context.device, "waiting links",
               std::max<uint64_t>(uint64_t(surfels) * wordsPerSurfel(), 1) * sizeof(uint32_t));
    context.stream.fill(bits_, 0);
    linksOfClasses_.assign(size_t(raysPerSurfel_) * kGroups, 0);
}

void WaitingLinks::count(PassContext& context) {
    context.stream.fill(classCounts_, 0);
    context.dispatch(count_, uint64_t(surfels_) * wordsPerSurfel(),
                     {bits(),
                      {"classCounts", classCounts_},
                      {"words", surfels_ * wordsPerSurfel()},
                      {"wordsPerSurfel", wordsPerSurfel()}});
    linksOfClasses_ = context.stream.readAs<uint32_t>(classCounts_, size_t(raysPerSurfel_) * kGroups);
}

uint64_t WaitingLinks::waiting() const {
    return std::accumulate(linksOfClasses_.begin(), linksOfClasses_.end(), uint64_t(0));
}

uint32_t WaitingLinks::select(PassContext& context, uint64_t most) {
    std::vector<uint32_t> selected(size_t(wordsPerSurfel()) * kGroups, 0);
    uint64_t links = 0;
    for (size_t passed = 0; passed < linksOfClasses_.size(); ++passed) {
        uint32_t& ofClass = linksOfClasses_[next_];
        if (links + ofClass > most) break;
        links += ofClass;
        ofClass = 0;
        const size_t ray = next_ / kGroups, group = next_ % kGroups;
        selected[group * wordsPerSurfel() + ray / 32] |= 1u << ray % 32;
        next_ = (next_ + 1) % linksOfClasses_.size();
    }
    context.stream.upload(selected_, selected);
    return uint32_t(links);
}

void WaitingLinks::list(PassContext& context, const Surfels::Chunk& chunk, uint32_t seed, const Bindings& list) const {
    context.dispatch(list_, chunk.count,
                     {bits(),
                      list.all(),
                      {"surfels", chunk.surfels},
                      {"selected", selected_},
                      {"count", chunk.count},
                      {"firstSurfel", chunk.firstIndex},
                      {"raysPerSurfel", raysPerSurfel_},
                      {"wordsPerSurfel", wordsPerSurfel()},
                      {"seed", seed}});
}

}  // namespace voxray
