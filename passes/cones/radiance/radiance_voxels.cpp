#include "passes/cones/radiance/radiance_voxels.h"

#include <cctype>

namespace voxray {

Defines RadianceVoxels::defines() const {
    std::string name = "RADIANCE_";
    for (const char letter : enumName(layout)) name += char(std::toupper(letter));
    Defines all{{name, "1"}};
    if (euclidean) all.emplace("RADIANCE_CLIPMAP_EUCLIDEAN", "1");
    return all;
}

std::vector<Binding> RadianceVoxels::bindings() const {
    std::vector<Binding> all{{"radianceVoxels", header}};
    if (octree.header)
        for (const Binding& binding : octree.bindings()) all.push_back(ifUsed(binding));
    if (texture) all.push_back(ifUsed({"radianceTexture", texture, sampler}));
    return all;
}

std::vector<Binding> RadianceVoxels::fillBindings(uint32_t mipLevel) const {
    std::vector<Binding> all = bindings();
    if (texture) all.emplace_back("radianceTarget", texture, mipLevel);
    return all;
}

}  // namespace voxray
