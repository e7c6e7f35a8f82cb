#include "graph/pass.h"

#include <algorithm>

namespace voxray {

bool PassContext::changed(const Resource& input) const {
    if (!seenVersions_) return true;
    const auto at = std::ranges::find(resources(), &input);
    return at == resources().end() || (*seenVersions_)[size_t(at - resources().begin())] != input.version;
}

bool PassContext::inputsChanged() {
    // Nobody else writes the outputs, so that their versions are as seen.
    const bool any = !seenVersions_ || std::ranges::any_of(resources(), [&](const Resource* resource) {
        return resource && changed(*resource);
    });
    outputsKept_ = !any;
    return any;
}

}  // namespace voxray
