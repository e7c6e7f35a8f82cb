#include "graph/registry.h"

namespace voxray {

const PassKind* Registry::find(const std::string& name) const {
    for (const PassKind& kind : kinds_)
        if (kind.name == name) return &kind;
    return nullptr;
}

const PassKind& Registry::require(const std::string& name, const TextLocation& where) const {
    if (const PassKind* kind = find(name)) return *kind;
    std::vector<std::string> names;
    for (const PassKind& kind : kinds_) names.push_back(kind.name);
    throw UsageError(where, "unknown pass '{}'{}", name, didYouMean(name, names));
}

}  // namespace voxray
