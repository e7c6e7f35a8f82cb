#include "scene/gltf_file.h"

#include <unistd.h>

#include <algorithm>
#include <map>

#include "base/files.h"
#include "scene/gltf_check.h"

namespace voxray {
namespace {

/// What tinygltf's file callbacks may touch: files below one folder.
struct Folder {
    std::filesystem::path path;
};

bool fileExists(const std::string& name, void* user) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(static_cast<const Folder*>(user)->path / name, ignored);
}

std::string expandPath(const std::string& name, void*) {
    return name;
}

bool readWholeFile(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* user) {
    try {
        *out = readFile(static_cast<const Folder*>(user)->path / name);
        return true;
    } catch (const Error& reason) {
        *error = reason.what();
        return false;
    }
}

bool writeNothing(std::string* error, const std::string&, const std::vector<unsigned char>&, void*) {
    *error = "a loader does not write";
    return false;
}

/// From 2.9 on tinygltf also asks for sizes.
template <typename Callbacks>
Callbacks callbacksFor(Folder& folder) {
    Callbacks callbacks{};
    callbacks.FileExists = fileExists;
    callbacks.ExpandFilePath = expandPath;
    callbacks.ReadWholeFile = readWholeFile;
    callbacks.WriteWholeFile = writeNothing;
    if constexpr (requires { callbacks.GetFileSizeInBytes; })
        callbacks.GetFileSizeInBytes = [](size_t* bytes, std::string* error, const std::string& name,
                                          void* user) {
            std::error_code failure;
            *bytes = std::filesystem::file_size(static_cast<const Folder*>(user)->path / name, failure);
            if (failure) *error = name + ": " + failure.message();
            return !failure;
        };
    callbacks.user_data = &folder;
    return callbacks;
}

/// Keeps an image's bytes for later.
bool keepImage(tinygltf::Image*, int index, std::string*, std::string*, int, int, const unsigned char* bytes,
               int size, void* user) {
    auto& images = *static_cast<std::map<int, std::vector<uint8_t>>*>(user);
    images[index].assign(bytes, bytes + size);
    return true;
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& path) : name_(path.string()) {
    // Check the outside before the parser sees it.
    const std::vector<uint8_t> bytes = readFile(path);
    if (bytes.size() > 0xffffffffu) fail("files of 4 GiB or more are not supported; split the scene");
    GltfOutline outline;
    try {
        outline = checkGltf(bytes);
    } catch (const Error& reason) {
        fail("{}", reason.what());
    }
    for (const std::string& extension : outline.unknownExtensions)
        warn("extension {} is not supported; what it adds is left out", extension);

    // Parse, with files and images handled here.
    Folder folder{path.parent_path()};
    std::map<int, std::vector<uint8_t>> images;
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(callbacksFor<tinygltf::FsCallbacks>(folder));
    parser.SetImageLoader(keepImage, &images);
    std::string error;
    std::string ignoredWarnings;
    const auto size = static_cast<unsigned int>(bytes.size());
    const bool parsed =
        outline.binary
            ? parser.LoadBinaryFromMemory(&model_, &error, &ignoredWarnings, bytes.data(), size, "")
            : parser.LoadASCIIFromString(&model_, &error, &ignoredWarnings,
                                         reinterpret_cast<const char*>(bytes.data()), size, "");
    if (!parsed || !error.empty()) fail("{}", error.empty() ? "it can't be parsed" : error);
    encodedImages_.resize(model_.images.size());
    for (auto& [index, data] : images) encodedImages_[size_t(index)] = std::move(data);
}

void GltfFile::reserve(uint64_t count, uint64_t bytesEach) {
    const uint64_t limit = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE)) / 2;
    if (count > (limit - std::min(limit, reservedBytes_)) / bytesEach)
        fail("it needs more than {} MiB, half of this machine's memory; use a smaller scene", limit >> 20);
    reservedBytes_ += count * bytesEach;
}

void GltfFile::addWarning(std::string line) {
    if (knownWarnings_.insert(line).second) warnings_.push_back(std::move(line));
}

}  // namespace voxray
