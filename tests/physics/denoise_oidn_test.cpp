// denoise_oidn, with a stand-in for the library (support/oidn_stand_in.cpp): what it is handed, and what it says where
// the library is missing, is another one, or reports an error.
#include <gtest/gtest.h>

#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

ImageF indirect(const std::string& passes, uint32_t width = 24) {
    return Chain("white_room", "{albedo: 0.5}",
                 "[{pass: gbuffer, samples_per_pixel_edge: 2}, " + passes + ", {pass: composite}]", width, 24)
        .image("indirect");
}

const std::string kPaths = "{pass: path_trace, id: paths, light: indirect, spp: 4}";
std::string denoiser(const std::string& library) {
    return ", {pass: denoise_oidn, library: '" + library + "'}";
}

TEST(DenoiseOidn, HandsOverRadianceAlbedoAndNormals) {
    const ImageF raw = indirect(kPaths), denoised = indirect(kPaths + denoiser(VOXRAY_OIDN_STAND_IN));
    for (size_t i = 0; i < raw.data.size(); ++i) EXPECT_NEAR(denoised.data[i], raw.data[i] + 10 * 0.5, 1e-3) << i;
}

TEST(DenoiseOidn, SaysHowToGetTheLibrary) {
    EXPECT_ERROR("openimagedenoise.org", indirect(kPaths + denoiser("libNowhere.so")));
    EXPECT_ERROR("has no oidnNewDevice", indirect(kPaths + denoiser("libc.so.6")));
}

TEST(DenoiseOidn, PassesTheLibrarysErrorsOn) {
    EXPECT_ERROR("seven columns are too many", indirect(kPaths + denoiser(VOXRAY_OIDN_STAND_IN), 7));
}

TEST(DenoiseOidn, RefusesPixelsWithoutRays) {
    EXPECT_ERROR("raise its rays",
                 indirect("{pass: voxelize, resolution: 16}, {pass: inject_light_rays, rays_per_light: 1024}, {pass: "
                          "trace_gather_rays, rays_per_block: 4, block: 8}, {pass: gather_rays}" +
                          denoiser(VOXRAY_OIDN_STAND_IN)));
}

}  // namespace
}  // namespace voxray::test
