#include "passes/final_gather/merged_voxels/merge_voxels/face_samples.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace voxray {
namespace {

constexpr int kBlock = 8;                // Voxels along an edge of a block.
constexpr double kMinErrorScale = 1e-3;  // Fraction of the mean irradiance of all faces.

std::vector<glm::ivec3> occupiedVoxels(CommandStream& stream, const SurfaceVoxels& voxels) {
    const std::vector<uint32_t> words = stream.readAs<uint32_t>(voxels.occupancy, voxels.words());
    const gpu::VoxelGrid& grid = voxels.grid;
    std::vector<glm::ivec3> list;
    for (uint32_t word = 0; word < words.size(); ++word) {
        const uint32_t row = word / grid.wordsPerRow;
        for (uint32_t bits = words[word]; bits != 0; bits &= bits - 1)
            list.emplace_back(word % grid.wordsPerRow * 32 + uint32_t(std::countr_zero(bits)), row % grid.resolution.y,
                              row / grid.resolution.y);
    }
    return list;
}

struct Mean {
    double area = 0, flux = 0;
    void add(const FaceSample& s) {
        area += s.area;
        flux += s.area * (s.irradiance.x + s.irradiance.y + s.irradiance.z) / 3;
    }
    double value() const { return area > 0 ? flux / area : 0; }
};

uint64_t blockOf(glm::ivec3 voxel) {
    const glm::u64vec3 block = glm::u64vec3(voxel / kBlock);
    return block.x | block.y << 16 | block.z << 32;
}

void setErrorScales(std::array<std::vector<FaceSample>, kFaces>& faces) {
    Mean all;
    std::unordered_map<uint64_t, Mean> blocks;
    for (const std::vector<FaceSample>& samples : faces)
        for (const FaceSample& s : samples) {
            all.add(s);
            blocks[blockOf(s.voxel)].add(s);
        }
    const double minScale = all.flux > 0 ? kMinErrorScale * all.value() : 1;
    for (std::vector<FaceSample>& samples : faces)
        for (FaceSample& s : samples) s.errorScale = std::max(blocks[blockOf(s.voxel)].value(), minScale);
}

}  // namespace

VoxelFaces readVoxelFaces(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelIrradiance& light,
                          bool withDirect) {
    const std::vector<glm::ivec3> occupied = occupiedVoxels(stream, voxels);
    const size_t count = voxels.voxelCount;
    const auto areas = stream.readAs<uint32_t>(light.area, count * kAreaWords);
    const auto indirect = stream.readAs<uint32_t>(light.indirect, count * kFluxWords);
    const auto direct =
        withDirect ? stream.readAs<uint32_t>(light.direct, count * kFluxWords) : std::vector<uint32_t>();
    const auto fluxOf = [](const std::vector<uint32_t>& words, size_t voxel, uint32_t face) {
        const size_t first = voxel * kFluxWords + face / 2 * FLUX_WORDS_PER_AXIS;
        return glm::dvec3(gpu::unpackFlux(words[first + face % 2], words[first + 2], face % 2 == 1));
    };

    VoxelFaces result;
    result.faceBits.resize((count + 3) / 4);
    const double faceArea = double(voxels.grid.voxelSize) * voxels.grid.voxelSize;
    for (size_t i = 0; i < count; ++i) {
        for (uint32_t face = 0; face < kFaces; ++face) {
            const uint32_t word = areas[i * kAreaWords + face / 2];
            const double area = gpu::unpackArea(face % 2 == 0 ? gpu::lowerOf(word) : gpu::upperOf(word));
            if (area == 0) continue;
            FaceSample s{occupied[i], area};
            s.irradiance = fluxOf(indirect, i, face);
            if (withDirect) s.irradiance += fluxOf(direct, i, face);
            s.irradiance /= area * faceArea;
            result.faces[face].push_back(s);
            result.faceBits[i / 4] |= 1u << (8 * (i % 4) + face);
        }
    }
    setErrorScales(result.faces);
    return result;
}

}  // namespace voxray
