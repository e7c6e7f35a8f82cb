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

/// Writes a file whole or not at all: a temporary file next to it (`.stem.NUMBER.tmp.ext`), flushed to disk,
/// then renamed. Many processes may write it at once, on many machines too: whichever comes last stays.
/// @throws Error naming the file and the system's reason (full disk, no permission).
void writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// Whether a file is called as such a temporary file: left by a killed process, if nobody writes just now.
bool isTemporaryName(const std::filesystem::path& path);

/// The same for writers that need a path: `write` gets a temporary path with the same extension.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write);

/// The same for a folder that `write` fills, under a temporary name next to it (kTemporaryFolder and more).
/// A folder that was there is replaced.
void writeFolderAtomically(const std::filesystem::path& folder,
                           const std::function<void(const std::filesystem::path&)>& write);
inline constexpr const char* kTemporaryFolder = ".tmp-";

/// Makes the folder and writes a file there for a moment. @return what went wrong, with the path, or "".
std::string whyNotWritable(const std::filesystem::path& folder);

/// Where Voxray keeps what it can make again (SPIR-V, references):
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
    template <typename T>
    Hasher& addPlain(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        return add(&value, sizeof value);
    }
    std::string hex() const;

 private:
    void* state_;
};

}  // namespace voxray
