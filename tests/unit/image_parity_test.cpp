#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "image/score.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

/// Every metric against tests/images/metrics_reference.py, an independent numpy version, on synthetic pairs.
namespace voxray {
namespace {
namespace fs = std::filesystem;

struct Pair {
    std::string name;
    ImageF test, reference;
};

// Uniform in [0, 1), a function of its arguments alone (the finalizer of MurmurHash3).
float noise(uint32_t x, uint32_t y, uint32_t salt) {
    uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ salt * 0xc2b2ae3du;
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return float((h ^ h >> 16) >> 8) / float(1 << 24);
}

// @param colour(x, y, channel) of each pixel
template <typename Colour>
ImageF paint(uint32_t width, uint32_t height, const Colour& colour) {
    ImageF image(width, height, 3);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (uint32_t c = 0; c < 3; ++c) image.pixel(x, y)[c] = colour(x, y, c);
    return image;
}

std::vector<Pair> syntheticPairs() {
    std::vector<Pair> pairs;
    pairs.push_back({"noise against noise", paint(61, 47, [](auto x, auto y, auto c) { return noise(x, y, c); }),
                     paint(61, 47, [](auto x, auto y, auto c) { return noise(x, y, c + 3); })});
    const auto board = [](uint32_t shift) {
        return [shift](uint32_t x, uint32_t y, uint32_t c) {
            return ((x + shift) / 7 + y / 5) % 2 ? 0.9f : 0.05f + 0.2f * float(c);
        };
    };
    pairs.push_back({"shifted checkerboard", paint(64, 40, board(1)), paint(64, 40, board(0))});
    pairs.push_back({"gradient with a tint",
                     paint(80, 24, [](auto x, auto, auto c) { return float(x) / 79 * (c == 2 ? 0.7f : 1.0f); }),
                     paint(80, 24, [](auto x, auto, auto) { return float(x) / 79; })});
    pairs.push_back({"saturated primaries",
                     paint(40, 40, [](auto x, auto, auto c) { return c == (x / 13) % 3 ? 1.0f : 0.0f; }),
                     paint(40, 40, [](auto, auto y, auto c) { return c == (y / 13) % 3 ? 1.0f : 0.0f; })});
    const auto radiance = [](uint32_t x, uint32_t y, uint32_t c) {
        return std::exp2(10.0f * std::sin(float(x) * 0.11f) * std::cos(float(y) * 0.07f) - 3.0f + 0.3f * float(c));
    };
    pairs.push_back({"high dynamic range with fireflies",
                     paint(72, 50,
                           [&](auto x, auto y, auto c) {
                               const bool firefly = noise(x, y, 9) > 0.99f;
                               return radiance(x, y, c) * (0.5f + noise(x, y, c)) * (firefly ? 100.0f : 1.0f);
                           }),
                     paint(72, 50, radiance)});
    pairs.push_back({"smaller than the filters", paint(12, 11, [](auto x, auto, auto) { return float(x) / 9; }),
                     paint(12, 11, [](auto, auto y, auto) { return 0.1f + float(y) / 12; })});
    return pairs;
}

void store(const fs::path& path, const Pair& pair) {
    std::ofstream out(path, std::ios::binary);
    const uint32_t size[] = {pair.test.width, pair.test.height};
    out.write(reinterpret_cast<const char*>(size), sizeof size);
    for (const ImageF* image : {&pair.test, &pair.reference})
        out.write(reinterpret_cast<const char*>(image->data.data()),
                  std::streamsize(image->data.size() * sizeof(float)));
}

TEST(ImageParity, EveryMetricAgreesWithNumpy) {
    // Hand the pairs to the numpy version.
    const test::TemporaryFolder folder;
    const std::vector<Pair> pairs = syntheticPairs();
    std::string command = "/usr/bin/python3 " + (test::sourceRoot() / "tests/images/metrics_reference.py").string();
    for (size_t i = 0; i < pairs.size(); ++i) {
        const fs::path file = folder / (std::to_string(i) + ".pair");
        store(file, pairs[i]);
        command += " " + file.string();
    }
    const fs::path answers = folder / "answers";
    ASSERT_EQ(std::system((command + " > " + answers.string()).c_str()), 0) << "needs python3-numpy";

    // Compare each metric in turn. Voxray reads float previews, hence 1e-5 and not less.
    std::ifstream in(answers);
    for (const Pair& pair : pairs) {
        ScoreOptions options;
        options.flipExposures = flipExposures(pair.reference);
        Scores scores = score({pair.test, pair.reference, options});
        while (!scores.empty()) {
            std::string name;
            double theirs = 0;
            ASSERT_TRUE(in >> name >> theirs) << scores.begin()->first << " is not in metrics_reference.py";
            ASSERT_TRUE(scores.count(name)) << name;
            const double value = scores.extract(name).mapped();
            EXPECT_NEAR(value, theirs, 1e-5 * std::max(1.0, std::abs(theirs))) << pair.name << ": " << name;
            RecordProperty(pair.name + ": " + name, std::to_string(value));
        }
    }
}

}  // namespace
}  // namespace voxray
