#include "passes/filter_voxels/radiance_storage.h"

namespace voxray {

// Each in the source of its layout.
std::unique_ptr<RadianceStorage> makeDenseStorage();
std::unique_ptr<RadianceStorage> makeSvoStorage();
std::unique_ptr<RadianceStorage> makeClipmapStorage(const ClipmapParams& params);
std::unique_ptr<RadianceStorage> makeTexturesStorage();
std::unique_ptr<RadianceStorage> makeSvoBricksStorage(const BrickParams& params);

std::unique_ptr<RadianceStorage> makeRadianceStorage(RadianceLayout layout, const ClipmapParams& clipmap,
                                                     const BrickParams& bricks) {
    switch (layout) {
        case RadianceLayout::Dense:
            return makeDenseStorage();
        case RadianceLayout::Svo:
            return makeSvoStorage();
        case RadianceLayout::Clipmap:
        case RadianceLayout::ClipmapTextures:
            return makeClipmapStorage(clipmap);
        case RadianceLayout::Textures:
            return makeTexturesStorage();
        case RadianceLayout::SvoBricks:
            return makeSvoBricksStorage(bricks);
    }
    return nullptr;
}

std::vector<Binding> surfaceRadianceBindings(const SurfaceVoxels& voxels, const SurfaceLight& light) {
    return voxels.bindings({{"DirectFluxAt", light.direct.at()},
                            {"IndirectFluxAt", light.indirect.at()},
                            {"voxelArea", light.area}});
}

}  // namespace voxray
