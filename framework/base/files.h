#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace voxray {

/// Whole file as bytes. @throws Error naming the file and the system's reason.
std::vector<uint8_t> readFile(const std::filesystem::path& path);
std::string readTextFile(const std::filesystem::path& path);

/// Writes a file atomically: to a temporary file next to it (`.stem.NUMBER.tmp.ext`), flushed to disk, then
/// renamed. Of concurrent writers, on several machines too, the last one wins.
/// @throws Error naming the file and the system's reason (full disk, no permission).
void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// Whether a file has the name of such a temporary file, which a killed process may leave.
bool isTemporaryName(const std::filesystem::path& path);

/// For writers that need a path: `write` gets a temporary path with the same extension.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write);

/// Writes a folder atomically: `write` fills a temporary one next to it (kTemporaryFolder and a suffix),
/// which replaces the old one.
void writeFolderAtomically(const std::filesystem::path& folder,
                           const std::function<void(const std::filesystem::path&)>& write);
inline constexpr const char* kTemporaryFolder = ".tmp-";

/// Creates the folder and a file in it, as a test. @return the error, with the path, or "".
std::string whyNotWritable(const std::filesystem::path& folder);

/// Folder of the caches (SPIR-V, references):
/// $VOXRAY_CACHE, else $XDG_CACHE_HOME/voxray, else ~/.cache/voxray.
std::filesystem::path cacheFolder();

/// 128-bit content hash as 32 hexadecimal digits.
class Hasher {
 public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    Hasher& add(const void* data, size_t bytes);
    Hasher& add(std::string_view text);  ///< Length first, so that "ab"+"c" differs from "a"+"bc".
    template <typename... T>
    Hasher& addPlain(const T&... values) {
        static_assert((std::is_trivially_copyable_v<T> && ...));
        (add(&values, sizeof values), ...);
        return *this;
    }
    std::string hex() const;

 private:
    void* state_;
};

}  // namespace voxray
