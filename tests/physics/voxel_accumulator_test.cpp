// Samples that meet in a voxel: each write mode against the mean, the maximum and the area that it must give.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/common/voxels/voxel_accumulator.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/kept.h"
#include "tests/support/programs.h"

namespace voxray::test {
namespace {

/// What `samples` samples of firstValue + slope * number leave in every second voxel of a room.
struct Merged {
    Merged(Write write, uint32_t samples, float firstValue, float slope, bool reversed = false, float white = 8) {
        static Chain& room =
            *kept(std::make_shared<Chain>("white_room", "{}", graphYaml({"voxelize, resolution: 12"})));
        const SurfaceVoxels& voxels = room.get<SurfaceVoxels>("voxels");
        TestPrograms programs;
        VoxelAccumulator writes(programs, {write, white});
        const Kernel writer(programs, "tests/gpu/voxel_accumulator.comp", VoxelAccumulator::defines(write));
        programs.compile();
        CommandStream stream(device());
        const LargeBuffer fluxBuffer(device(), "flux", voxels.voxelCount * kFluxWords * sizeof(uint32_t));
        const Buffer areaBuffer(device(), "area", voxels.voxelCount * kAreaWords * sizeof(uint32_t));
        stream.fill(areaBuffer, 0);
        writes.begin(device(), stream, voxels, firstValue);
        stream.dispatch(writer, uint64_t(voxels.voxelCount) * samples,
                        {writes,
                         {"voxelCount", voxels.voxelCount},
                         {"samples", samples},
                         {"reversed", reversed},
                         {"firstValue", firstValue},
                         {"slope", slope},
                         {"scale", writes.scale()}});
        writes.resolve(stream, voxels, fluxBuffer, areaBuffer);
        stream.finish();
        flux = unpackFlux(stream.readAs<uint32_t>(fluxBuffer, voxels.voxelCount * kFluxWords));
        area = unpackAreas(stream.readAs<uint32_t>(areaBuffer, voxels.voxelCount * kAreaWords));
        materials = readMaterials(room, voxels);
        faceArea = voxels.grid.voxelSize * voxels.grid.voxelSize;
    }
    /// Largest distance of any lit face's irradiance from `expected` (of the first channel; the others' is
    /// 2 and 4 times that), relative to the channel's.
    double worst(double expected) const {
        double largest = 0;
        int faces = 0;
        for (size_t face = 0; face < area.size(); ++face) {
            if (area[face] <= 0) continue;
            ++faces;
            for (size_t c = 0; c < 3; ++c) {
                const double channel = expected * double(1u << c);
                largest = std::max(largest, std::abs(flux[face * 3 + c] / (area[face] * faceArea) / channel - 1));
            }
        }
        EXPECT_GT(faces, 100);
        return largest;
    }
    std::vector<float> flux, area;
    std::vector<gpu::VoxelMaterial> materials;
    double faceArea = 0;
};

/// Of 13 bits of the largest of three channels, which is four times the smallest here (voxel_packing.h).
constexpr double kPacked = 4.0 / (1 << 13);

TEST(VoxelAccumulator, AllAgreeOnOneValue) {
    EXPECT_LT(Merged(Write::Average, 300, 1.7f, 0).worst(1.7), kPacked);
    EXPECT_LT(Merged(Write::Max, 300, 1.7f, 0).worst(1.7), kPacked);
    EXPECT_LT(Merged(Write::None, 300, 1.7f, 0).worst(1.7), kPacked);
    // 8 bits: half a step of 8 / 255 W/m² on the darkest channel, 1.7.
    EXPECT_LT(Merged(Write::MovingAverage, 300, 1.7f, 0).worst(1.7), 0.5 * 8 / 255 / 1.7 + kPacked);
}

TEST(VoxelAccumulator, AverageIsTheMeanAndMaxTheLargest) {
    // 0.5 + 0.01 k for k = 0 ... 100: mean 1, maximum 1.5.
    EXPECT_LT(Merged(Write::Average, 101, 0.5f, 0.01f).worst(1.0), kPacked);
    EXPECT_LT(Merged(Write::Max, 101, 0.5f, 0.01f).worst(1.5), kPacked);
    // The thesis's loop rounds each step to 8 bits: it stays near the mean, not on it.
    EXPECT_LT(Merged(Write::MovingAverage, 101, 0.5f, 0.01f).worst(1.0), 0.5);
}

TEST(VoxelAccumulator, NoneStoresOneSampleAsItIs) {
    // Samples of 1 and 3: whichever came last, and no mean of both.
    const Merged merged(Write::None, 2, 1, 2);
    int faces = 0;
    for (size_t face = 0; face < merged.area.size(); ++face) {
        if (merged.area[face] <= 0) continue;
        ++faces;
        for (size_t c = 0; c < 3; ++c) {
            const double value = merged.flux[face * 3 + c] / (merged.area[face] * merged.faceArea) / double(1u << c);
            EXPECT_LT(std::min(std::abs(value - 1), std::abs(value / 3 - 1)), kPacked);
        }
    }
    EXPECT_GT(faces, 100);
}

TEST(VoxelAccumulator, AverageDoesNotDependOnOrder) {
    const Merged forwards(Write::Average, 101, 0.123f, 0.037f), backwards(Write::Average, 101, 0.123f, 0.037f, true);
    EXPECT_EQ(forwards.flux, backwards.flux);
}

TEST(VoxelAccumulator, AverageKeepsBrightAndDimSamples) {
    // 1 and 20004 times the typical irradiance in the brightest channel: no overflow, no loss.
    EXPECT_LT(Merged(Write::Average, 2, 0.01f, 50.0f).worst(25.01), kPacked);
}

TEST(VoxelAccumulator, WhiteBoundsTheMovingAverage) {
    const Merged clipped(Write::MovingAverage, 4, 0.5f, 0, false, 1.0f);
    // Channels 0.5, 1 and 2: the last is cut off at 1.
    for (size_t face = 0; face < clipped.area.size(); ++face) {
        if (clipped.area[face] <= 0) continue;
        const double area = clipped.area[face] * clipped.faceArea;
        EXPECT_NEAR(clipped.flux[face * 3] / area, 0.5, 0.5 / 255 + kPacked);
        EXPECT_NEAR(clipped.flux[face * 3 + 2] / area, 1.0, kPacked);
    }
}

TEST(VoxelAccumulator, AreaIsUnoccludedWhereSamplesFell) {
    for (const Write write : {Write::Average, Write::Max, Write::MovingAverage, Write::None}) {
        const Merged merged(write, 3, 1, 0);
        for (size_t voxel = 0; voxel < merged.materials.size(); ++voxel)
            for (size_t axis = 0; axis < 3; ++axis) {
                const gpu::VoxelMaterial& m = merged.materials[voxel];
                const bool written = voxel % 2 == 0;
                ASSERT_EQ(merged.area[voxel * 6 + 2 * axis], written ? m.unoccludedPositive[int(axis)] : 0);
                ASSERT_EQ(merged.area[voxel * 6 + 2 * axis + 1], written ? m.unoccludedNegative[int(axis)] : 0);
            }
    }
}

}  // namespace
}  // namespace voxray::test
