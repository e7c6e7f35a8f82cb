#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "image/image.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

/// Which layer of an EXR file is its picture.
namespace voxray::test {
namespace {

class ExrLayers : public testing::Test {
 protected:
    /// A file of 2 x 1 pixels whose channel number c holds c.
    std::filesystem::path store(const std::vector<std::string>& channels) const {
        ImageF image(2, 1, uint32_t(channels.size()));
        for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = float(i % channels.size());
        writeExr(path_, image, channels);
        return path_;
    }
    /// Red, green and blue of what is read.
    std::vector<float> read(const std::vector<std::string>& channels, const std::string& layer = "") const {
        const LayeredImage read = readLayer(store(channels), layer);
        EXPECT_EQ(read.image.width, 2u);
        taken_ = read.layer;
        return {read.image.data.begin() + 3, read.image.data.end()};
    }

    const TemporaryFolder folder_;
    const std::filesystem::path path_ = folder_ / "layers.exr";
    mutable std::string taken_;
};

using Values = std::vector<float>;

TEST_F(ExrLayers, PlainChannelsComeFirstInAnyOrder) {
    EXPECT_EQ(read({"AO.R", "AO.G", "AO.B", "R", "G", "B"}), Values({3, 4, 5}));
    EXPECT_EQ(taken_, "");
    EXPECT_EQ(read({"B", "G", "R", "Z"}), Values({2, 1, 0}));
    EXPECT_EQ(read({"A", "B", "G", "R"}), Values({3, 2, 1}));
    EXPECT_EQ(read({"depth.Z", "Y"}), Values({1, 1, 1}));
}

TEST_F(ExrLayers, TheWholePictureIsChosenByItsName) {
    const std::vector<std::string> blender = {"View.AO.R",       "View.AO.G",       "View.AO.B",
                                              "View.Combined.R", "View.Combined.G", "View.Combined.B",
                                              "View.Combined.A", "View.Depth.Z"};
    EXPECT_EQ(read(blender), Values({3, 4, 5}));
    EXPECT_EQ(taken_, "View.Combined");
    EXPECT_EQ(read(blender, "View.AO"), Values({0, 1, 2}));
    EXPECT_EQ(read(blender, "ao"), Values({0, 1, 2}));
    EXPECT_EQ(read(blender, "Depth"), Values({7, 7, 7}));
    EXPECT_EQ(read({"diffuse.R", "diffuse.G", "diffuse.B", "beauty.B", "beauty.G", "beauty.R"}), Values({5, 4, 3}));
    EXPECT_EQ(read({"Z", "only.R", "only.G", "only.B"}), Values({1, 2, 3}));
}

TEST_F(ExrLayers, WhatIsNotClearIsRefusedWithTheNames) {
    const std::vector<std::string> two = {"left.R", "left.G", "left.B", "right.R", "right.G", "right.B"};
    EXPECT_ERROR("its layers: left, right", read(two));
    EXPECT_EQ(read(two, "right"), Values({3, 4, 5}));
    EXPECT_ERROR("'other'", read(two, "other"));
    EXPECT_ERROR("no layer", read({"a.U", "a.V", "b.U", "b.V"}));
}

TEST_F(ExrLayers, PartsAreLayersAndWholeNumbersAreNoPicture) {
    const auto out = OIIO::ImageOutput::create("openexr");
    std::vector<OIIO::ImageSpec> parts;
    for (const char* name : {"AO", "beauty", "id"}) {
        OIIO::ImageSpec spec(2, 1, 3, name == std::string("id") ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::HALF);
        spec.channelnames = {"R", "G", "B"};
        spec.attribute("oiio:subimagename", name);
        parts.push_back(spec);
    }
    ASSERT_TRUE(out->open(path_.string(), int(parts.size()), parts.data()));
    for (int part = 0; part < 3; ++part) {
        if (part > 0) {
            ASSERT_TRUE(out->open(path_.string(), parts[size_t(part)], OIIO::ImageOutput::AppendSubimage));
        }
        const Values values(6, float(part) + 0.5f);
        ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, values.data())) << out->geterror();
    }
    ASSERT_TRUE(out->close());
    const LayeredImage read = readLayer(path_, "");
    EXPECT_EQ(read.layer, "beauty");
    EXPECT_EQ(read.image.data, Values(6, 1.5f));
    EXPECT_EQ(readLayer(path_, "AO").image.data, Values(6, 0.5f));
    EXPECT_ERROR("whole numbers", readLayer(path_, "id"));
}

}  // namespace
}  // namespace voxray::test
