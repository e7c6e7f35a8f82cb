#include "graph/pass.h"

#include "base/error.h"

namespace voxray {

Resource& PortAccess::required(const Port& port) const {
    Resource* resource = bound(port);
    if (!resource) throw Error("a pass accesses a port that it doesn't have with these parameters");
    return *resource;
}

bool PassContext::changed(const Resource& input) const {
    for (size_t p = 0; p < resources_.size(); ++p)
        if (resources_[p] == &input && !owner_.ports()[p].output)
            return !seenVersions_ || (*seenVersions_)[p] != input.version;
    throw Error("a pass asks whether a resource changed that is none of its inputs");
}

bool PassContext::inputsChanged() {
    bool isChanged = !seenVersions_;
    for (size_t p = 0; p < resources_.size() && !isChanged; ++p)
        isChanged = resources_[p] && !owner_.ports()[p].output && changed(*resources_[p]);
    outputsUnchanged_ = !isChanged;
    return isChanged;
}

}  // namespace voxray
