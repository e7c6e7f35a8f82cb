#include "graph/pass.h"

#include <algorithm>

namespace voxray {

bool PassContext::changed(const Resource& input) const {
    if (!seenVersions_) return true;
    const auto found = std::ranges::find(resources(), &input);
    return found == resources().end() ||
           (*seenVersions_)[size_t(found - resources().begin())] != input.version;
}

bool PassContext::inputsChanged() {
    // Outputs never differ: only this pass writes them.
    const bool isChanged = !seenVersions_ || std::ranges::any_of(resources(), [&](const Resource* resource) {
        return resource && changed(*resource);
    });
    outputsUnchanged_ = !isChanged;
    return isChanged;
}

}  // namespace voxray
