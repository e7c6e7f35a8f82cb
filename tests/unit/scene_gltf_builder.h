#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/load.h"
#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

namespace voxray::test {

using nlohmann::json;

constexpr int byteType = 5120, ubyteType = 5121, shortType = 5122, ushortType = 5123, uintType = 5125, floatType = 5126;

inline void writeBytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream out(path, std::ios::binary);
    out.write(bytes.data(), std::streamsize(bytes.size()));
}

inline std::string base64(const std::string& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t j = 0; j < 3; ++j)
            group = group << 8 | (i + j < bytes.size() ? uint32_t(uint8_t(bytes[i + j])) : 0u);
        for (size_t j = 0; j < 4; ++j) out += i + j > bytes.size() ? '=' : digits[group >> (18 - 6 * j) & 63];
    }
    return out;
}

/// Makes glTF files: JSON as it stands in `root`, binary data in one buffer.
struct GltfBuilder {
    json root = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    template <typename T>
    int view(const std::vector<T>& values, int stride = 0) {
        while (bytes.size() % 4 != 0) bytes += '\0';
        json entry = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}};
        if (stride > 0) entry["byteStride"] = stride;
        if (!values.empty()) bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return add("bufferViews", entry);
    }
    int add(const char* list, json entry) {
        root[list].push_back(std::move(entry));
        return int(root[list].size() - 1);
    }
    int accessor(int view, size_t count, const char* type, int componentType, json more = json::object()) {
        more.update({{"bufferView", view}, {"count", count}, {"type", type}, {"componentType", componentType}});
        return add("accessors", more);
    }
    template <typename T>
    int floats(const std::vector<T>& values, const char* type) {
        return accessor(view(values), values.size(), type, floatType);
    }
    /// A mesh of one primitive and its node.
    int primitive(json primitive, json node = json::object()) {
        node["mesh"] = add("meshes", {{"primitives", json::array({std::move(primitive)})}});
        return add("nodes", node);
    }
    /// Three vertices: (0,0,0) (1,0,0) (0,1,0), facing +Z.
    int triangle(json more = json::object(), json node = json::object()) {
        more["attributes"]["POSITION"] = floats(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "VEC3");
        return primitive(std::move(more), std::move(node));
    }

    std::string glb() const {
        json complete = root;
        std::string bin = bytes;
        while (bin.size() % 4 != 0) bin += '\0';
        if (!bin.empty() && !complete.contains("buffers"))
            complete["buffers"] = json::array({{{"byteLength", bin.size()}}});
        return glb(complete.dump(), bin);
    }
    static std::string glb(std::string text, const std::string& bin) {
        while (text.size() % 4 != 0) text += ' ';
        std::string out = "glTF";
        const auto u32 = [&](size_t value) {
            for (int shift = 0; shift < 32; shift += 8) out += char(value >> shift & 0xff);
        };
        u32(2);
        u32(12 + 8 + text.size() + (bin.empty() ? 0 : 8 + bin.size()));
        u32(text.size());
        out += "JSON" + text;
        if (bin.empty()) return out;
        u32(bin.size());
        out += std::string("BIN\0", 4) + bin;
        return out;
    }
    /// The same as .gltf with the data in the text.
    std::string gltf() const {
        json complete = root;
        complete["buffers"] = {
            {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return complete.dump();
    }
    std::shared_ptr<const Scene> load() const {
        const TemporaryFolder folder;
        writeBytes(folder / "scene.glb", glb());
        return loadGltf(folder / "scene.glb");
    }
    /// What the loader says of a file that it must refuse; checks that it is one line that names the file.
    std::string error() const {
        const std::string text = errorOf([&] { load(); });
        EXPECT_CONTAINS(text, "scene.glb");
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return text;
    }
};

inline bool warns(const Scene& scene, const std::string& text) {
    for (const std::string& warning : scene.warnings)
        if (warning.find(text) != std::string::npos) return true;
    return false;
}

inline void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

/// A 2 x 1 PNG: red with alpha 255, green with alpha 0.
inline std::vector<uint8_t> tinyPng() {
    return {137, 80, 78, 71, 13, 10,  26, 10,  0,   0,  0,   13,  73, 72, 68, 82, 0,  0,   0,   2,  0,   0,   0,   1,
            8,   6,  0,  0,  0,  244, 34, 127, 138, 0,  0,   0,   15, 73, 68, 65, 84, 120, 156, 99, 248, 207, 192, 240,
            31,  8,  25, 0,  15, 249, 2,  254, 45,  71, 129, 244, 0,  0,  0,  0,  73, 69,  78,  68, 174, 66,  96,  130};
}

}  // namespace voxray::test
