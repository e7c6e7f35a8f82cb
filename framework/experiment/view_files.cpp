#include "experiment/view_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.h"

namespace voxray {
namespace {

static_assert(std::endian::native == std::endian::little);

/// numpy.dtype.str
const char* codeOf(ViewInfo::Type type) {
    switch (type) {
        case ViewInfo::Type::Uint8:
            return "|u1";
        case ViewInfo::Type::Uint32:
            return "<u4";
        case ViewInfo::Type::Uint64:
            return "<u8";
        case ViewInfo::Type::Float16:
            return "<f2";
        case ViewInfo::Type::Float32:
            return "<f4";
    }
    throw Error("no such type of values");
}

}  // namespace

void writeNpy(const std::filesystem::path& path, const ViewArray& view) {
    constexpr size_t kAlignment = 64, kPrefixBytes = 10;
    std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}", codeOf(view.type),
                                     fmt::join(view.shape, ", "));
    const size_t unpadded = kPrefixBytes + header.size() + 1;
    header += std::string((kAlignment - unpadded % kAlignment) % kAlignment, ' ') + "\n";
    std::string file("\x93NUMPY\x01\x00", 8);
    file += char(header.size() & 255);
    file += char(header.size() >> 8);
    file += header;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(file.data(), std::streamsize(file.size()));
    out.write(reinterpret_cast<const char*>(view.bytes.data()), std::streamsize(view.bytes.size()));
    out.close();
    if (!out) throw Error("{}: {}", path.string(), std::strerror(errno));
}

std::filesystem::path writeView(const std::filesystem::path& folder, const ViewArray& view) {
    if (view.channels.empty()) {
        writeNpy(folder / "view.npy", view);
        return folder / "view.npy";
    }
    writeExr(folder / "view.exr", imageOf(view), view.channels);
    return folder / "view.exr";
}

}  // namespace voxray
