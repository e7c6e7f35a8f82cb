#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/files.h"
#include "image/image.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

namespace voxray {
namespace {
namespace fs = std::filesystem;

class ImageFiles : public testing::Test {
 protected:
    fs::path file(const char* name) const { return folder_ / name; }
    void store(const fs::path& path, const std::vector<uint8_t>& bytes, size_t count) const {
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(count));
    }

    const test::TemporaryFolder folder_;
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

TEST_F(ImageFiles, APlainExrHasTheSamePixels) {
    const ImageF image = gradient(37, 23, 3);
    writePlainExr(file("plain.exr"), image);
    EXPECT_EQ(readImage(file("plain.exr")).data, image.data);
    writePlainExr(file("plain.exr"), gradient(5, 4, 3));  // In its place
    EXPECT_EQ(readImage(file("plain.exr")).width, 5u);
    EXPECT_THROW(writePlainExr(file("a.exr"), ImageF(2, 2, 2)), Error);
    EXPECT_THROW(writePlainExr(file("no folder") / "a.exr", image), Error);
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

TEST_F(ImageFiles, PreviewIsClampedSrgbOfTheImageAtItsExposure) {
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

TEST_F(ImageFiles, ChangedBytesGiveAnErrorOrAPicture) {
    writeExr(file("whole.exr"), gradient(21, 30, 3));
    writePng(file("whole.png"), gradient(21, 30, 3));
    uint32_t random = 1;
    for (const char* extension : {".exr", ".png"}) {
        const std::vector<uint8_t> whole = readFile(file((std::string("whole") + extension).c_str()));
        const fs::path changed = file((std::string("changed") + extension).c_str());
        for (int i = 0; i < 200; ++i) {
            // Change up to three bytes, half the time in the header.
            std::vector<uint8_t> bytes = whole;
            for (int k = 0; k <= i % 3; ++k) {
                random = random * 1664525u + 1013904223u;
                const size_t range = i % 2 ? bytes.size() : std::min<size_t>(bytes.size(), 400);
                bytes[(random >> 8) % range] = uint8_t(random >> 24);
            }
            store(changed, bytes, bytes.size());
            try {
                const ImageF image = readImage(changed);
                EXPECT_EQ(image.data.size(), image.pixelCount() * 3);
            } catch (const Error& error) {
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            }
        }
    }
}

TEST_F(ImageFiles, EncodedPngGivesItsBytesBack) {
    // Colour under transparent texels stays; equal texels take little room.
    DecodedImage image{64, 33, {}};
    for (uint32_t i = 0; i < 64 * 33; ++i)
        for (uint32_t c = 0; c < 4; ++c) image.rgba.push_back(i < 640 ? uint8_t(i * (c + 3)) : uint8_t(50 * c));
    const std::vector<uint8_t> png = encodePng(image);
    const DecodedImage back = decodeImage(png, "back.png");
    EXPECT_EQ(back.width, 64u);
    EXPECT_EQ(back.height, 33u);
    EXPECT_EQ(back.rgba, image.rgba);
    EXPECT_LT(png.size(), image.rgba.size() / 2);
    EXPECT_EQ(encodePng(image), png);
    EXPECT_THROW(encodePng({2, 2, {1, 2, 3}}), Error);
}

TEST_F(ImageFiles, ADamagedPngIsRefusedBeforeItsDecoderSpeaks) {
    std::vector<uint8_t> png = encodePng({64, 64, std::vector<uint8_t>(64 * 64 * 4, 99)});
    png[png.size() - 20] ^= 1;  // In the last IDAT chunk.
    testing::internal::CaptureStderr();
    EXPECT_THROW(decodeImage(png, "damaged.png"), Error);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ImageFiles, AHugeClaimIsRefused) {
    // 65535 x 65535 pixels in a few bytes of PNG.
    const std::vector<uint8_t> png = fromHex(
        "89504e470d0a1a0a 0000000d49484452 0000ffff0000ffff0802000000 39674e07"
        "0000000849444154 789c030000000001 480689d2 0000000049454e44ae426082");
    EXPECT_ERROR("huge.png: 65535 x 65535 pixels", decodeImage(png, "huge.png"));
}

// Small files, made by hand, of every kind that glTF textures come in.
// 8 x 8 pixels of grey 77.
constexpr const char* kGreyJpeg =
    "ffd8ffe000104a46494600010100000100010000ffdb004300030202030202030303030403030405"
    "0805050404050a070706080c"
    "0a0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f171816141812141514ffc000"
    "0b080008000801011100ffc4"
    "0014000100000000000000000000000000000008ffc4001410010000000000000000000000000000"
    "0000ffda0008010100003f00"
    "3bbfffd9";

struct Encoded {
    const char* kind;
    const char* hex;
    std::vector<uint8_t> rgba;  // First pixels
    int tolerance;
};

class Decoding : public testing::TestWithParam<Encoded> {};

TEST_P(Decoding, GivesTheFilesOwnBytes) {
    const Encoded& encoded = GetParam();
    const DecodedImage image = decodeImage(fromHex(encoded.hex), encoded.kind);
    ASSERT_EQ(image.rgba.size(), size_t(image.width) * image.height * 4);
    ASSERT_GE(image.rgba.size(), encoded.rgba.size());
    for (size_t i = 0; i < encoded.rgba.size(); ++i)
        EXPECT_NEAR(image.rgba[i], encoded.rgba[i], encoded.tolerance) << "byte " << i;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Decoding,
    testing::Values(Encoded{"palette_with_alpha",
                            "89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb800000006504c54"
                            "450a141ec8643277a0b39c"
                            "0000000274524e53ff40936b71da0000000b49444154789c636060040000040002bf7a3f4a000000"
                            "0049454e44ae426082",
                            {10, 20, 30, 255, 200, 100, 50, 64},
                            0},
                    Encoded{"grey_and_alpha",
                            "89504e470d0a1a0a0000000d49484452000000020000000108040000005e2bb7010000000d494441"
                            "54789c63486960670000"
                            "032300ec60b685c80000000049454e44ae426082",
                            {100, 100, 100, 128, 7, 7, 7, 0},
                            0},
                    Encoded{"rgb_of_16_bits",
                            "89504e470d0a1a0a0000000d4948445200000001000000011002000000c0e78f9d0000000f494441"
                            "54789c63f8ffbfa1819111"
                            "000e7f0301a25288120000000049454e44ae426082",
                            {255, 128, 1, 255},
                            0},
                    Encoded{"grey_of_1_bit",
                            "89504e470d0a1a0a0000000d49484452000000020000000101000000"
                            "00dc5942270000000a49444154789c636800000082008177cd72b60000000049454e44ae426082",
                            {255, 255, 255, 255, 0, 0, 0, 255},
                            0},
                    Encoded{"rgba_with_gamma",
                            "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000467414d"
                            "41000186a031e8965f0000"
                            "000d49444154789c63389162c4050004bf0169326d012c0000000049454e44ae426082",
                            {200, 100, 50, 10},
                            0},
                    Encoded{"jpeg_grey", kGreyJpeg, {77, 77, 77, 255}, 2},
                    Encoded{"jpeg_colour",
                            "ffd8ffe000104a46494600010100000100010000ffdb004300030202030202030303030403030405"
                            "0805050404050a070706080c"
                            "0a0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f171816141812141514ffdb00"
                            "430103040405040509050509"
                            "140d0b0d141414141414141414141414141414141414141414141414141414141414141414141414"
                            "1414141414141414141414"
                            "141414141414141414ffc00011080010001003012200021101031101ffc400150001010000000000"
                            "0000000000000000000007ff"
                            "c40014100100000000000000000000000000000000ffc40015010101000000000000000000000000"
                            "00000608ffc40014110100"
                            "000000000000000000000000000000ffda000c03010002110311003f00850034b75fffd9",
                            {200, 30, 60, 255},
                            3}),
    [](const auto& param) { return std::string(param.param.kind); });

TEST(DecodeImage, RefusesCutAndForeignBytes) {
    // Every proper prefix of a file is refused.
    const std::vector<uint8_t> png = fromHex(
        "89504e470d0a1a0a0000000d49484452000000020000000108040000005e2bb7010000000d49444154789c63486960670000"
        "032300ec60b685c80000000049454e44ae426082");
    for (size_t size = 0; size < png.size(); ++size)
        EXPECT_THROW(decodeImage(std::span(png).first(size), "cut.png"), Error) << size;
    EXPECT_THROW(decodeImage(fromHex("ffd8ffe000104a464946000101"), "cut.jpg"), Error);
    EXPECT_ERROR("PNG or JPEG", decodeImage(fromHex("474946383961010001000000"), "a.gif"));
    EXPECT_ERROR("ktx extract", decodeImage(fromHex("ab4b5458203230bb0d0a1a0a"), "a"));
}

TEST(DecodeImage, AJpegMayLackItsEndMarkerAlone) {
    const std::vector<uint8_t> whole = fromHex(kGreyJpeg);
    const auto without = std::span(whole).first(whole.size() - 2);
    EXPECT_EQ(decodeImage(without, "a.jpg").rgba, decodeImage(whole, "b.jpg").rgba);
    for (size_t size = 0; size + 4 < whole.size(); ++size)
        EXPECT_THROW(decodeImage(std::span(whole).first(size), "cut.jpg"), Error) << size;
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

TEST_F(ImageFiles, AFullDiskIsNamedWithTheSpaceThere) {
    // No file may grow beyond 2 KiB: the image fails while it is written
    rlimit before;
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{2048, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string message = errorOf([&] { writeExr(file("a.exr"), gradient(64, 64, 3)); });
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);

    EXPECT_EQ(message.find(file("a.exr").string() + ": "), 0u) << message;
    const uint64_t free = fs::space(folder_).available >> 20;
    const size_t at = message.rfind("; ");
    ASSERT_NE(at, std::string::npos) << message;
    EXPECT_CONTAINS(message, " MiB are free there");
    EXPECT_NEAR(std::stod(message.substr(at + 2)), double(free), 0.1 * double(free) + 64) << message;
    EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ImageFiles, ExrCarriesNoTimeOfDay) {
    // Equal images are equal files: the header's date is a constant.
    writeExr(file("a.exr"), gradient(8, 4, 3));
    EXPECT_CONTAINS(readTextFile(file("a.exr")), "1970:01:01 00:00:00");
}

}  // namespace
}  // namespace voxray
