#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <span>

#include "image/image.h"
#include "scene/geometry.h"
#include "scene/load.h"
#include "scene_texts.h"

namespace voxray::test {

/// Loads a scene again and again, each time with one of its files damaged. It must load, or be refused by an Error of
/// one line; sanitizers see the rest.
class DamagedScenes : public testing::Test {
 protected:
    using Load = std::shared_ptr<const Scene> (*)(const std::filesystem::path&);

    /// @param root name of the file to load @param files by name; with them are sky.exr of this size, and a.png
    DamagedScenes(Load load, std::string root, std::map<std::string, std::string> files, ImageF sky)
        : load_(load), root_(std::move(root)), files_(std::move(files)) {
        for (const auto& [name, bytes] : files_) writeText(folder_ / name, bytes);
        writeExr(folder_ / "sky.exr", sky);
        writePng(folder_ / "a.png", ImageF(2, 2, 3, 0.5f));
    }

    std::shared_ptr<const Scene> load() const { return load_(folder_ / root_); }

    /// Loads the scene with one other file. Anything but success or one clear line fails the test.
    void check(const std::string& name, const std::string& bytes, const std::string& what) {
        writeText(folder_ / name, bytes);
        try {
            const Geometry g = evaluate(load(), 0).geometry;
            ++loaded_;
            size_t outside = 0;
            for (const glm::uvec3& t : g.triangles)
                if (std::max({t.x, t.y, t.z}) >= g.positions.size()) ++outside;
            ASSERT_EQ(outside, 0u) << what;
            size_t notUnit = 0;
            for (const VertexAttributes& a : g.attributes)
                if (!(std::abs(glm::length(a.normal) - 1) < 1e-3f)) ++notUnit;
            ASSERT_EQ(notUnit, 0u) << what;
        } catch (const Error& error) {
            ++refused_;
            ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << what << ": " << error.what();
        } catch (const std::exception& error) {
            FAIL() << what << ": not an Error: " << error.what();
        }
        writeText(folder_ / name, files_.at(name));
    }

    void flipBits(const std::string& name, int count, uint32_t seed) {
        std::mt19937 random(seed);
        for (int i = 0; i < count; ++i) {
            std::string bad = files_.at(name);
            for (int f = 0; f < 1 + i % 3; ++f) bad[random() % bad.size()] ^= char(1 << random() % 8);
            check(name, bad, name + ", flip " + std::to_string(i));
        }
    }
    void cut(const std::string& name, size_t step) {
        for (size_t size = 0; size < files_.at(name).size(); size += step)
            check(name, files_.at(name).substr(0, size), name + ", cut " + std::to_string(size));
    }
    /// Puts each text in the place of each part of a file. @param parts places and lengths
    void replaceEach(const std::string& name, const std::vector<std::pair<size_t, size_t>>& parts,
                     std::span<const char* const> texts) {
        for (const auto& [at, length] : parts)
            for (const char* text : texts) {
                std::string bad = files_.at(name);
                bad.replace(at, length, text);
                check(name, bad, fmt::format("'{}' at {}", text, at));
            }
    }
    void TearDown() override {
        RecordProperty("loaded", int(loaded_));
        RecordProperty("refused", int(refused_));
        EXPECT_GT(refused_, 0u);
        EXPECT_GT(loaded_, 0u);
    }

 private:
    const Load load_;
    const std::string root_;
    const std::map<std::string, std::string> files_;
    TemporaryFolder folder_;
    size_t loaded_ = 0, refused_ = 0;
};

}  // namespace voxray::test
