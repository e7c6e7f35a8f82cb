#include "scene/gltf_file.h"

#include <algorithm>
#include <limits>

#include "base/files.h"
#include "scene/gltf_check.h"
#include "scene/gltf_compression.h"
#include "scene/gltf_json.h"
#include "scene/gltf_repair.h"

namespace voxray {
namespace {

using nlohmann::json;

/// Removes the strides of buffer views: the parser accepts only multiples of 4 up to 252.
std::vector<size_t> removeStrides(json& root) {
    std::vector<size_t> strides;
    for (size_t i = 0; i < objects(root, "bufferViews").size(); ++i) {
        json& view = root["bufferViews"][i];
        strides.push_back(unsignedMember(view, "byteStride", fmt::format("bufferView {}", i), 0));
        view.erase("byteStride");
    }
    return strides;
}

/// Removes the indices of primitives, by mesh: the parser refuses sparse ones without a buffer view.
std::vector<int> removeIndices(json& root) {
    std::vector<int> indices;
    for (size_t m = 0; m < objects(root, "meshes").size(); ++m)
        for (size_t p = 0; p < objects(root["meshes"][m], "primitives").size(); ++p) {
            json& primitive = root["meshes"][m]["primitives"][p];
            const uint64_t none = std::numeric_limits<int>::max();
            const uint64_t number =
                unsignedMember(primitive, "indices", fmt::format("mesh {}, primitive {}", m, p), none);
            indices.push_back(number == none ? -1 : int(std::min(number, none - 1)));
            primitive.erase("indices");
        }
    return indices;
}

/// Parses the JSON without buffers and images, which are read separately.
tinygltf::Model parsed(json root) {
    const std::vector<size_t> strides = removeStrides(root);
    const std::vector<int> indices = removeIndices(root);
    root.erase("buffers");
    root.erase("images");
    const std::string text = root.dump();
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string error, ignoredWarnings;
    const bool good = parser.LoadASCIIFromString(&model, &error, &ignoredWarnings, text.data(),
                                                 static_cast<unsigned int>(text.size()), "");
    if (!good || !error.empty()) throw Error("{}", error.empty() ? "it can't be parsed" : error);
    for (size_t i = 0; i < model.bufferViews.size(); ++i) model.bufferViews[i].byteStride = strides[i];
    size_t primitives = 0;
    for (tinygltf::Mesh& mesh : model.meshes)
        for (tinygltf::Primitive& primitive : mesh.primitives) primitive.indices = indices[primitives++];
    return model;
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& path) : name_(path.string()) {
    const std::vector<uint8_t> bytes = readFile(path);
    if (bytes.size() > 0xffffffffu) fail("files of 4 GiB or more are not supported; split the scene");
    try {
        parse(bytes, path.parent_path());
    } catch (const Error& reason) {
        fail("{}", reason.what());
    }
}

void GltfFile::parse(const std::vector<uint8_t>& bytes, const std::filesystem::path& folder) {
    // Check the file and read all data before parsing.
    GltfContainer container = openGltf(bytes);
    for (const std::string& extension : checkGltf(container.root))
        warn("extension {} is not supported; what it adds is left out", extension);
    GltfBuffers buffers = readBuffers(container, folder);
    images_ = readImages(container.root, buffers, folder);
    for (const std::string& line : repairGltf(container.root)) warn("{}", line);
    const ReserveMemory counted = [this](uint64_t count, uint64_t bytesEach) { memory_.reserve(count, bytesEach); };
    expandMeshopt(container.root, buffers, counted);
    expandDraco(container.root, buffers, counted);

    model_ = parsed(std::move(container.root));
    for (std::vector<uint8_t>& buffer : buffers) model_.buffers.emplace_back().data = std::move(buffer);
}

void GltfFile::reserve(uint64_t count, uint64_t bytesEach) {
    try {
        memory_.reserve(count, bytesEach);
    } catch (const Error& reason) {
        fail("{}", reason.what());
    }
}

void GltfFile::addWarning(std::string line) {
    if (knownWarnings_.insert(line).second) warnings_.push_back(std::move(line));
}

}  // namespace voxray
