#include "passes/common/radiance/radiance_voxels.h"

namespace voxray {

Defines RadianceVoxels::defines() const {
    switch (layout) {
        case RadianceLayout::Dense:
            return {{"RADIANCE_DENSE", "1"}};
        case RadianceLayout::Svo:
            return {{"RADIANCE_SVO", "1"}};
        case RadianceLayout::Clipmap:
            return {{"RADIANCE_CLIPMAP", "1"}};
    }
    return {};
}

std::vector<Binding> RadianceVoxels::bindings() const {
    std::vector<Binding> all{{"radianceVoxels", header}};
    if (layout == RadianceLayout::Svo)
        for (const Binding& binding : octree.bindings()) all.push_back(ifUsed(binding));
    return all;
}

}  // namespace voxray
