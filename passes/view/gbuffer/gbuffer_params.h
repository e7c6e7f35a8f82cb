#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "base/schema.h"

namespace voxray {

enum class GBufferMethod { Rays, Raster };

template <>
struct EnumNames<GBufferMethod> {
    static constexpr std::array names{std::pair{GBufferMethod::Rays, "rays"},
                                      std::pair{GBufferMethod::Raster, "raster"}};
};

enum class SamplePattern { Regular, Rotated, Random };

template <>
struct EnumNames<SamplePattern> {
    static constexpr std::array names{std::pair{SamplePattern::Regular, "regular"},
                                      std::pair{SamplePattern::Rotated, "rotated"},
                                      std::pair{SamplePattern::Random, "random"}};
};

/// What has a material of its own.
enum class MaterialsOf { Samples, Surfaces };

template <>
struct EnumNames<MaterialsOf> {
    static constexpr std::array names{std::pair{MaterialsOf::Samples, "samples"},
                                      std::pair{MaterialsOf::Surfaces, "surfaces"}};
};

enum class TextureLookup { Filtered, Sharp };

template <>
struct EnumNames<TextureLookup> {
    static constexpr std::array names{std::pair{TextureLookup::Filtered, "filtered"},
                                      std::pair{TextureLookup::Sharp, "sharp"}};
};

/// Parameters of the pass `gbuffer`.
struct GBufferParams {
    GBufferMethod method = GBufferMethod::Rays;
    uint32_t samplesPerPixelEdge = 1;
    SamplePattern samplePattern = SamplePattern::Regular;
    MaterialsOf materialsOf = MaterialsOf::Samples;
    TextureLookup normalMaps = TextureLookup::Filtered;
    TextureLookup colors = TextureLookup::Filtered;
    static constexpr auto schema() {
        return std::tuple{
            field("method", &GBufferParams::method,
                  "rays: camera rays, which hit the same surfaces as all other rays; "
                  "on a CPU a tenth of raster's time in a large scene. "
                  "raster: for GPUs with slow or no ray tracing."),
            field("samples_per_pixel_edge", &GBufferParams::samplesPerPixelEdge,
                  "Samples along each edge of a pixel: 2 for 4 samples a pixel. "
                  "Later passes process every sample.",
                  1u, 8u),
            field(
                "sample_pattern", &GBufferParams::samplePattern,
                "Where samples are in their pixel. regular: the centers of a regular grid. rotated: a rotated grid, in "
                "which no two are in a column or a row: edges along either are as smooth as others. random: one point "
                "of each of the grid's cells, another one in each frame and with each seed: noise in place of what a "
                "grid misses in every frame.")
                .onlyWith(oneOf(&GBufferParams::method, {GBufferMethod::Rays})),
            field("materials_of", &GBufferParams::materialsOf,
                  "samples: each has normals and a material of its own. surfaces: where all samples of a pixel hit one "
                  "surface, they share those at the pixel's center, as with multisampling, and differ by their "
                  "points; textures are filtered over the pixel.")
                .onlyWith(oneOf(&GBufferParams::method, {GBufferMethod::Rays})),
            field("normal_maps", &GBufferParams::normalMaps,
                  "filtered: the mean normal over a sample's footprint, biased as it flattens detail. "
                  "sharp: the normal at the sample's point: noise instead, which samples_per_pixel_edge lowers."),
            field("colors", &GBufferParams::colors,
                  "filtered: the mean color over a sample's footprint, by mip levels. "
                  "sharp: the color at the sample's point, with aliasing where texels are smaller "
                  "than the distance of samples, as published in Magalhães 2020 (section 5.1.4), for comparison.")};
    }
};

}  // namespace voxray
