#include "base/files.h"

#define XXH_INLINE_ALL
#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <random>

#include "base/disk_full.h"
#include "base/error.h"
#include "base/suggest.h"

namespace voxray {
namespace fs = std::filesystem;

namespace {

// Flushes a file or folder to disk, so that a rename never publishes an empty file.
void syncPath(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw Error("{}: {}", path.string(), std::strerror(errno));
    const int result = ::fsync(descriptor);
    const int reason = errno;
    ::close(descriptor);
    if (result != 0 && reason != EINVAL) throw Error("{}: {}", path.string(), std::strerror(reason));
}

/// Whether a folder's disk is full, which libraries that write files don't report.
bool isFull(const fs::path& folder) {
    constexpr uint64_t kRoom = 1 << 16;
    std::error_code code;
    const fs::space_info space = fs::space(folder.empty() ? "." : folder, code);
    return !code && space.capacity > 0 && space.available < kRoom;
}

// For names that are unique across machines that share the folder, which process ids are not.
std::string randomNumber() {
    std::random_device random;
    return std::to_string((uint64_t(random()) << 32) | random());
}

// Moves a folder to a path, replacing an existing one. Of two concurrent processes the last one wins.
void replaceFolder(const fs::path& from, const fs::path& to) {
    constexpr int kTries = 100;
    for (int attempt = 0; attempt < kTries; ++attempt) {
        std::error_code code, ignored;
        fs::rename(from, to, code);
        if (!code) return;
        if (code != std::errc::directory_not_empty && code != std::errc::file_exists)
            throw fs::filesystem_error("rename", to, code);
        const fs::path old = from.parent_path() / (kTemporaryFolder + ("old-" + randomNumber()));
        fs::rename(to, old, ignored);
        fs::remove_all(old, ignored);
    }
    throw Error("{}: other processes replace it again and again", to.string());
}

}  // namespace

std::vector<uint8_t> readFile(const fs::path& path) {
    std::error_code code;
    if (fs::is_directory(path, code)) throw Error("{}: is a folder, not a file", path.string());
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        const int reason = errno;
        throw Error("{}: {}{}", path.string(), std::strerror(reason), reason == ENOENT ? didYouMeanFile(path) : "");
    }
    std::vector<uint8_t> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    if (in.bad()) throw Error("{}: read failed", path.string());
    return bytes;
}

std::string readTextFile(const fs::path& path) {
    const std::vector<uint8_t> bytes = readFile(path);
    return {bytes.begin(), bytes.end()};
}

bool isTemporaryName(const fs::path& path) {
    const fs::path name = path.extension() == ".tmp" ? path.filename() : path.stem();
    const std::string process = name.stem().extension().string();
    return name.string().starts_with('.') && name.extension() == ".tmp" && process.size() > 1 &&
           process.find_first_not_of("0123456789", 1) == std::string::npos;
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    std::error_code code;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), code);
    if (code) throw Error("{}: {}", path.parent_path().string(), code.message());
    const fs::path temporary = path.parent_path() / fs::path("." + path.stem().string() + "." + randomNumber() +
                                                             ".tmp" + path.extension().string());
    try {
        write(temporary);
        syncPath(temporary);
        fs::rename(temporary, path);
    } catch (const std::exception& error) {
        const bool full = isFull(path.parent_path());  // Before the incomplete file is deleted.
        fs::remove(temporary, code);
        if (full) throw DiskFull(path.parent_path());
        if (const auto* system = dynamic_cast<const fs::filesystem_error*>(&error))
            throw Error("{}: {}", path.string(), system->code().message());
        throw;
    }
}

void writeFileAtomically(const fs::path& path, std::string_view content) {
    writeFileAtomically(path, [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
        out.write(content.data(), std::streamsize(content.size()));
        out.close();
        if (!out) throw Error("{}: {}", path.string(), std::strerror(errno));
    });
}

void writeFolderAtomically(const fs::path& folder, const std::function<void(const fs::path&)>& write) {
    const fs::path temporary =
        folder.parent_path() / (kTemporaryFolder + folder.filename().string() + "-" + randomNumber());
    std::error_code ignored;
    try {
        fs::create_directories(temporary);
        write(temporary);
        replaceFolder(temporary, folder);
    } catch (const DiskFull&) {
        fs::remove_all(temporary, ignored);
        throw DiskFull(folder.parent_path());
    } catch (...) {
        fs::remove_all(temporary, ignored);
        throw;
    }
}

std::string whyNotWritable(const fs::path& folder) {
    const fs::path probe = folder / (".writable-" + randomNumber());
    std::error_code ignored;
    try {
        writeFileAtomically(probe, std::string(1 << 16, ' '));  // A full disk may take an empty file.
        fs::remove(probe, ignored);
        return {};
    } catch (const std::exception& error) {
        return error.what();
    }
}

fs::path cacheFolder() {
    if (const char* folder = std::getenv("VOXRAY_CACHE"); folder && *folder) return folder;
    if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder) return fs::path(folder) / "voxray";
    if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "voxray";
    return fs::temp_directory_path() / "voxray-cache";
}

Hasher::Hasher() : state_(XXH3_createState()) {
    XXH3_128bits_reset(static_cast<XXH3_state_t*>(state_));
}
Hasher::~Hasher() {
    XXH3_freeState(static_cast<XXH3_state_t*>(state_));
}

Hasher& Hasher::add(const void* data, size_t bytes) {
    XXH3_128bits_update(static_cast<XXH3_state_t*>(state_), data, bytes);
    return *this;
}

Hasher& Hasher::add(std::string_view text) {
    const uint64_t length = text.size();
    add(&length, sizeof length);
    return add(text.data(), text.size());
}

std::string Hasher::hex() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(static_cast<const XXH3_state_t*>(state_));
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace voxray
