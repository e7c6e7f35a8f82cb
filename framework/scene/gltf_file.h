#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/one_line.h"
#include "scene/gltf_data.h"
#include "scene/memory_budget.h"
#include "scene/tiny_gltf.h"

namespace voxray {

/// oneLine(), cut to 200 bytes: a name may be as long as its file.
inline std::string shortLine(std::string_view text) {
    return oneLine(text, 200);
}

/// A parsed glTF file, with checked indices, errors that name the file, warnings, and a bound on the memory
/// that a small file can demand.
class GltfFile {
 public:
    /// Reads and parses; buffers are loaded and decompressed, images are read but not decoded.
    /// URIs may only name files in the file's folder and below.
    /// @throws Error
    explicit GltfFile(const std::filesystem::path& path);

    const tinygltf::Model& model() const { return model_; }
    /// Encoded images, in the file's order.
    const std::vector<EncodedImage>& images() const { return images_; }

    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) const {
        throw Error("{}: {}", name_, oneLine(fmt::format(text, std::forward<Args>(args)...), kMaxMessage));
    }

    /// Adds a line to the warnings, once.
    template <typename... Args>
    void warn(fmt::format_string<Args...> text, Args&&... args) {
        addWarning(oneLine(fmt::format(text, std::forward<Args>(args)...), kMaxMessage));
    }
    const std::vector<std::string>& warnings() const { return warnings_; }

    /// An array's element by an index in the file. @throws Error if it is out of range.
    template <typename T>
    const T& at(const std::vector<T>& array, int64_t index, const char* what) const {
        if (index < 0 || uint64_t(index) >= array.size())
            fail("{} {} is used, but the file has {} of them", what, index, array.size());
        return array[size_t(index)];
    }

    /// Counts memory before its allocation. @throws Error if the total exceeds half of the machine's memory.
    void reserve(uint64_t count, uint64_t bytesEach);

 private:
    static constexpr size_t kMaxMessage = 500;  ///< Bytes; names in a file can be longer.

    void addWarning(std::string line);
    void parse(const std::vector<uint8_t>& bytes, const std::filesystem::path& folder);

    std::string name_;
    tinygltf::Model model_;
    std::vector<EncodedImage> images_;
    std::vector<std::string> warnings_;
    std::set<std::string> knownWarnings_;
    MemoryBudget memory_;
};

}  // namespace voxray
