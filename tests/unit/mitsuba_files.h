#pragma once

#include <zlib.h>

#include <cstring>
#include <string>
#include <vector>

#include "scene/geometry.h"
#include "scene/load.h"
#include "scene_texts.h"

/// Small Mitsuba scenes for tests.
namespace voxray::test {

/// A scene of version 3 with these elements.
inline std::string mitsubaScene(const std::string& elements) {
    return "<scene version=\"3.0.0\">\n" + elements + "\n</scene>\n";
}

inline std::shared_ptr<const Scene> loadElements(const TemporaryFolder& folder, const std::string& elements) {
    writeText(folder / "scene.xml", mitsubaScene(elements));
    return loadMitsuba(folder / "scene.xml");
}

/// A triangle with normals and texture coordinates.
inline const char* const kTriangleObj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0.25\nvt 1 0.25\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n";

inline std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(uLong(bytes.size()));
    std::string out(size, '\0');
    compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
             uLong(bytes.size()));
    out.resize(size);
    return out;
}

template <typename T>
void append(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A serialized file of meshes of one triangle each, the first corner at x = the mesh's number.
/// @param flags 0x1000 or 0x2000 for floats or doubles, 0x2 with texture coordinates
inline std::string serializedFile(uint16_t version, uint32_t flags, uint32_t meshes) {
    std::string file;
    std::vector<uint64_t> offsets;
    for (uint32_t m = 0; m < meshes; ++m) {
        offsets.push_back(file.size());
        append(file, uint16_t(0x041C));
        append(file, version);
        std::string body;
        append(body, flags);
        if (version == 4) body += std::string("mesh") + '\0';
        append(body, uint64_t(3));
        append(body, uint64_t(1));
        const auto number = [&](double value) {
            if (flags & 0x2000)
                append(body, value);
            else
                append(body, float(value));
        };
        for (const double value : {double(m), 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 5.0, 0.0}) number(value);
        if (flags & 0x2)
            for (const double value : {0.0, 0.25, 1.0, 0.0, 0.0, 1.0}) number(value);
        for (const uint32_t index : {0u, 1u, 2u}) append(body, index);
        file += deflated(body);
    }
    for (const uint64_t offset : offsets) {
        if (version == 4)
            append(file, offset);
        else
            append(file, uint32_t(offset));
    }
    append(file, meshes);
    return file;
}

}  // namespace voxray::test
