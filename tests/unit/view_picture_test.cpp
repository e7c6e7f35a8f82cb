// How views of passes become pictures, and files.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "base/files.h"
#include "experiment/view_files.h"
#include "experiment/view_picture.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

namespace voxray {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

ViewArray imageView(uint32_t channels, const std::vector<float>& values, Quantity quantity) {
    ImageF image(uint32_t(values.size()) / channels, 1, channels);
    image.data = values;
    ViewInfo info;
    info.quantity = quantity;
    return viewOfImage(info, image, std::vector<std::string>(channels, "C"));
}

template <typename T>
ViewArray buffer(ViewInfo::Type type, const std::vector<uint64_t>& shape, const std::vector<T>& values) {
    ViewInfo info;
    info.kind = ViewInfo::Kind::Buffer;
    info.type = type;
    info.shape = shape;
    ViewArray view{info, std::vector<std::byte>(values.size() * sizeof(T)), shape[0]};
    std::memcpy(view.bytes.data(), values.data(), view.bytes.size());
    return view;
}

std::vector<float> displayed(const ViewArray& view, const ImageSettings& settings = {}) {
    return pictureOf(view, settings).display.data;
}

std::vector<float> grey(const std::vector<float>& values) {
    std::vector<float> all;
    for (const float value : values) all.insert(all.end(), 3, value);
    return all;
}

TEST(ViewPicture, RadianceIsShownAsTheImage) {
    ImageSettings settings;
    settings.exposureStops = -1;
    const std::vector<float> values{0.5f, 1, 4, 0, 0.25f, kInfinity};
    const ViewArray view = imageView(3, values, Quantity::Radiance);
    EXPECT_EQ(displayed(view, settings), preview(imageOf(view), -1).data);
    EXPECT_TRUE(contains(pictureOf(view, settings).legend, "-1 stops"));
}

TEST(ViewPicture, NaNIsMagenta) {
    for (const Quantity quantity : {Quantity::Radiance, Quantity::Fraction, Quantity::Direction, Quantity::Other}) {
        const ViewPicture picture = pictureOf(imageView(3, {kNaN, 0, 0, 1, 1, 1}, quantity), {});
        EXPECT_EQ(std::vector<float>(picture.display.data.begin(), picture.display.data.begin() + 3),
                  (std::vector<float>{1, 0, 1}));
        EXPECT_TRUE(contains(picture.legend, "magenta: NaN (1 values)"));
    }
    EXPECT_FALSE(contains(pictureOf(imageView(1, {0, 1}, Quantity::Other), {}).legend, "magenta"));
}

TEST(ViewPicture, ComponentsOfDirectionsAreFromMinusOneToOne) {
    EXPECT_EQ(displayed(imageView(3, {0, 1, -1, 0, 0, 0}, Quantity::Direction)),
              (std::vector<float>{0.5f, 1, 0, 0, 0, 0}));
}

TEST(ViewPicture, OtherValuesAreScaledByPercentiles) {
    EXPECT_EQ(displayed(imageView(1, {2, 4, 3, kInfinity, -kInfinity}, Quantity::Other)), grey({0, 1, 0.5f, 1, 0}));
    std::vector<float> values(1001);
    for (size_t i = 0; i < values.size(); ++i) values[i] = float(i);
    const ViewPicture picture = pictureOf(imageView(1, values, Quantity::Other), {});
    EXPECT_EQ(picture.range, (std::pair{10.0, 990.0}));
    EXPECT_TRUE(contains(picture.legend, "black: 10, white: 990"));
    // One value alone: 0 is black, others white
    EXPECT_EQ(displayed(imageView(1, {0, 0}, Quantity::Other)), grey({0, 0}));
    EXPECT_EQ(displayed(imageView(1, {7, 7}, Quantity::Other)), grey({1, 1}));
    EXPECT_EQ(displayed(imageView(1, {kInfinity, kInfinity}, Quantity::Other)), grey({1, 1}));
    // Two channels are red and green
    EXPECT_EQ(displayed(imageView(2, {0, 1, 1, 0}, Quantity::Other)), (std::vector<float>{0, 1, 0, 1, 0, 0}));
}

TEST(ViewPicture, NumbersHaveAColorEach) {
    const std::vector<float> colors = displayed(imageView(1, {-1, 0, 1, 0}, Quantity::Number));
    const auto color = [&](int i) { return std::vector<float>(colors.begin() + 3 * i, colors.begin() + 3 * i + 3); };
    EXPECT_EQ(color(0), (std::vector<float>{0, 0, 0}));
    EXPECT_EQ(color(1), color(3));
    EXPECT_NE(color(1), color(2));
    EXPECT_NE(color(1), color(0));
}

TEST(ViewPicture, ABufferStandsRowByRow) {
    const ViewPicture words =
        pictureOf(buffer<uint32_t>(ViewInfo::Type::Uint32, {10, 2}, std::vector<uint32_t>(20, 0)), {});
    EXPECT_EQ(words.display.width % 2, 0u);
    EXPECT_GE(words.display.width * words.display.height, 20u);
    EXPECT_LT(words.display.width * (words.display.height - 1), 20u);
    EXPECT_EQ(words.display.data, std::vector<float>(words.display.data.size(), 0));
    // Elements of three values are colors
    const ViewPicture colors = pictureOf(buffer<float>(ViewInfo::Type::Float32, {2, 3}, {0, 1, 1, 1, 0, 0}), {});
    EXPECT_EQ(colors.display.data, (std::vector<float>{0, 1, 1, 1, 0, 0}));
    // The first values of a long one
    ViewArray part = buffer<uint32_t>(ViewInfo::Type::Uint32, {4}, {1, 2, 3, 4});
    part.elements = 100;
    EXPECT_TRUE(contains(pictureOf(part, {}).legend, "the first 4 of 100 values"));
    const std::vector<uint8_t> many(kMaxPictureValues + 5);
    EXPECT_TRUE(contains(pictureOf(buffer<uint8_t>(ViewInfo::Type::Uint8, {many.size()}, many), {}).legend,
                         "the first 1048576 of 1048581 values"));
}

TEST(ViewPicture, SlicesOfAVolumeStandSideBySide) {
    ViewArray volume = buffer<float>(ViewInfo::Type::Float32, {2, 1, 2, 1}, {0, 1, 1, 0});
    volume.kind = ViewInfo::Kind::Image;
    const ViewPicture picture = pictureOf(volume, {});
    EXPECT_EQ(picture.display.width, 4u);
    EXPECT_EQ(picture.display.data, grey({0, 1, 1, 0}));
}

TEST(ViewFile, IsAnArrayOfNumPy) {
    const test::TemporaryFolder folder;
    const auto file = writeView(folder, buffer<uint32_t>(ViewInfo::Type::Uint32, {3}, {1, 2, 3}));
    const std::string text = readTextFile(file);
    EXPECT_EQ(text.size() % 64, 12u);
    EXPECT_TRUE(contains(text, "{'descr': '<u4', 'fortran_order': False, 'shape': (3,), }"));
    EXPECT_EQ(text.substr(text.size() - 12), std::string("\1\0\0\0\2\0\0\0\3\0\0\0", 12));
    EXPECT_EQ(writeView(folder, imageView(1, {1, 2}, Quantity::Other)).extension(), ".exr");
}

}  // namespace
}  // namespace voxray
