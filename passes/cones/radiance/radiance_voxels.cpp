#include "passes/cones/radiance/radiance_voxels.h"

#include <cctype>

namespace voxray {

Defines RadianceVoxels::defines() const {
    std::string name = "RADIANCE_";
    for (const char letter : enumName(layout)) name += char(std::toupper(letter));
    Defines defines{{name, "1"}};
    if (euclidean) defines.emplace("RADIANCE_CLIPMAP_EUCLIDEAN", "1");
    return defines;
}

std::vector<Binding> RadianceVoxels::bindings() const {
    std::vector<Binding> bound{{"radianceVoxels", header}};
    if (octree.header)
        for (const Binding& binding : octree.bindings()) bound.push_back(ifUsed(binding));
    if (texture) bound.push_back(ifUsed({"radianceTexture", texture, sampler}));
    return bound;
}

std::vector<Binding> RadianceVoxels::fillBindings(uint32_t mipLevel) const {
    std::vector<Binding> bound = bindings();
    if (texture) bound.emplace_back("radianceTarget", texture, mipLevel);
    return bound;
}

}  // namespace voxray
