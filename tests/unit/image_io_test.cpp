#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/files.h"
#include "image/image.h"

namespace voxray {
namespace {
namespace fs = std::filesystem;

class ImageFiles : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("voxray-image-" + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path file(const char* name) const { return folder_ / name; }
    void store(const fs::path& path, const std::vector<uint8_t>& bytes, size_t count) const {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(count));
    }

    fs::path folder_;
};

// Bytes of a hexadecimal text; blanks are skipped.
std::vector<uint8_t> fromHex(const std::string& text) {
    std::vector<uint8_t> bytes;
    std::string digits;
    for (const char c : text) {
        if (c == ' ') continue;
        digits += c;
        if (digits.size() < 2) continue;
        bytes.push_back(uint8_t(std::stoi(digits, nullptr, 16)));
        digits.clear();
    }
    return bytes;
}

ImageF gradient(uint32_t width, uint32_t height, uint32_t channels) {
    ImageF image(width, height, channels);
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = std::fmod(float(i) * 0.37f, 5.0f) - 0.5f;
    return image;
}

TEST_F(ImageFiles, ExrKeepsEveryBit) {
    ImageF image = gradient(37, 23, 3);
    image.data[5] = 1e20f;
    image.data[6] = 1e-30f;
    writeExr(file("a.exr"), image);
    const ImageF back = readImage(file("a.exr"));
    EXPECT_EQ(back.width, 37u);
    EXPECT_EQ(back.height, 23u);
    EXPECT_EQ(back.channels, 3u);
    EXPECT_EQ(back.data, image.data);
}

TEST_F(ImageFiles, EqualImagesGiveEqualFiles) {
    for (const char* name : {"a.exr", "b.exr"}) writeExr(file(name), gradient(37, 23, 3));
    EXPECT_EQ(readFile(file("a.exr")), readFile(file("b.exr")));
    for (const char* name : {"a.png", "b.png"}) writePng(file(name), gradient(37, 23, 3));
    EXPECT_EQ(readFile(file("a.png")), readFile(file("b.png")));
}

TEST_F(ImageFiles, GreyExrReadsAsThreeEqualChannels) {
    const ImageF image = gradient(5, 4, 1);
    writeExr(file("grey.exr"), image);
    const ImageF back = readImage(file("grey.exr"));
    ASSERT_EQ(back.channels, 3u);
    for (size_t i = 0; i < back.data.size(); ++i) EXPECT_EQ(back.data[i], image.data[i / 3]);
}

TEST_F(ImageFiles, PngRoundsAndReadsBackAsLinear) {
    ImageF display(3, 1, 3);
    display.data = {0.0f, 0.5f, 1.0f, -1.0f, 2.0f, 0.2f, 0.04f, 0.7f, 0.9f};
    writePng(file("a.png"), display);
    const DecodedImage bytes = decodeImage(readFile(file("a.png")), "a.png");
    const std::vector<uint8_t> expected = {0, 128, 255, 255, 0, 255, 51, 255, 10, 179, 230, 255};
    EXPECT_EQ(bytes.rgba, expected);
    const ImageF linear = readImage(file("a.png"));
    EXPECT_NEAR(linear.data[1], std::pow((128 / 255.0 + 0.055) / 1.055, 2.4), 1e-6);
    EXPECT_NEAR(linear.data[6], 10 / 255.0 / 12.92, 1e-6);
}

TEST_F(ImageFiles, PreviewIsClampedSrgbOfTheExposedImage) {
    ImageF linear(4, 1, 1);
    linear.data = {0.09f, -3.0f, 7.0f, 0.001f};
    const ImageF display = preview(linear, 1.0f);
    EXPECT_NEAR(display.data[0], 1.055 * std::pow(0.18, 1 / 2.4) - 0.055, 1e-6);
    EXPECT_EQ(display.data[1], 0.0f);
    EXPECT_NEAR(display.data[2], 1.0f, 1e-6);
    EXPECT_NEAR(display.data[3], 0.002 * 12.92, 1e-7);
}

TEST_F(ImageFiles, DamagedFilesAreErrors) {
    // A file cut anywhere gives an error, never a picture with holes.
    writeExr(file("whole.exr"), gradient(61, 80, 3));
    writePng(file("whole.png"), gradient(61, 80, 3));
    for (const char* extension : {".exr", ".png"}) {
        const std::vector<uint8_t> bytes = readFile(file((std::string("whole") + extension).c_str()));
        const fs::path cut = file((std::string("cut") + extension).c_str());
        for (const double part : {0.0, 0.01, 0.05, 0.2, 0.5, 0.9, 0.98}) {
            store(cut, bytes, size_t(part * double(bytes.size())));
            EXPECT_THROW(readImage(cut), Error) << extension << " cut at " << part;
        }
    }

    // So does one that is no image, or none at all.
    store(file("text.exr"), {'h', 'e', 'l', 'l', 'o'}, 5);
    EXPECT_THROW(readImage(file("text.exr")), Error);
    EXPECT_THROW(readImage(file("missing.exr")), Error);
    EXPECT_THROW(readImage(folder_), Error);
}

TEST_F(ImageFiles, AHugeClaimIsRefused) {
    // 65535 x 65535 pixels in a few bytes of PNG.
    const std::vector<uint8_t> png = fromHex(
        "89504e470d0a1a0a 0000000d49484452 0000ffff 0000ffff 0802000000 00000000 0000000049454e44ae426082");
    EXPECT_THROW(decodeImage(png, "huge.png"), Error);
}

TEST_F(ImageFiles, WhatCannotBeWrittenIsAnErrorAndLeavesNothing) {
    EXPECT_THROW(writeExr(file("a.exr"), ImageF(2, 2, 2)), Error);
    EXPECT_THROW(writeExr(file("a.exr"), ImageF()), Error);
    ImageF holes(2, 2, 3);
    holes.data[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(writePng(file("a.png"), holes), Error);
    writeExr(file("not-a-folder"), ImageF(2, 2, 3));
    EXPECT_THROW(writeExr(file("not-a-folder") / "a.exr", ImageF(2, 2, 3)), Error);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace voxray
