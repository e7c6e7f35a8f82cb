#include "passes/cones/radiance/radiance_voxels.h"

#include "passes/common/compute/enum_define.h"

namespace voxray {

Defines RadianceVoxels::defines() const {
    Defines defines{{enumDefine("RADIANCE_", layout), "1"}};
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
