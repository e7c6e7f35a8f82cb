#include "passes/cones/filter_voxels/radiance_storage.h"

namespace voxray {

// Defined in the source files of the layouts.
std::unique_ptr<RadianceStorage> makeDenseStorage(ProgramOwner& owner);
std::unique_ptr<RadianceStorage> makeSvoStorage(ProgramOwner& owner);
std::unique_ptr<RadianceStorage> makeClipmapStorage(ProgramOwner& owner, const ClipmapParams& params);
std::unique_ptr<RadianceStorage> makeTexturesStorage(ProgramOwner& owner);
std::unique_ptr<RadianceStorage> makeSvoBricksStorage(ProgramOwner& owner, const BrickParams& params);

std::unique_ptr<RadianceStorage> makeRadianceStorage(ProgramOwner& owner, RadianceLayout layout,
                                                     const ClipmapParams& clipmap, const BrickParams& bricks) {
    switch (layout) {
        case RadianceLayout::Dense:
            return makeDenseStorage(owner);
        case RadianceLayout::Svo:
            return makeSvoStorage(owner);
        case RadianceLayout::Clipmap:
        case RadianceLayout::ClipmapTextures:
            return makeClipmapStorage(owner, clipmap);
        case RadianceLayout::Textures:
            return makeTexturesStorage(owner);
        case RadianceLayout::SvoBricks:
            return makeSvoBricksStorage(owner, bricks);
    }
    return nullptr;
}

}  // namespace voxray
