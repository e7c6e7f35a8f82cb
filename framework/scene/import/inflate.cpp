#include "scene/import/inflate.h"

#include <zlib.h>

#include <algorithm>
#include <limits>

#include "base/error.h"

namespace voxray {
namespace {

/// A stream of zlib that ends with its scope.
class Inflater {
 public:
    Inflater() {
        constexpr int largestWindow = 15, anyHeader = 32;
        if (inflateInit2(&stream_, largestWindow + anyHeader) != Z_OK) throw Error("zlib can't be started");
    }
    ~Inflater() { inflateEnd(&stream_); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    z_stream& stream() { return stream_; }

 private:
    z_stream stream_{};
};

}  // namespace

bool isGzip(std::span<const uint8_t> bytes) {
    return bytes.size() >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
}

std::vector<uint8_t> inflateBytes(std::span<const uint8_t> bytes, MemoryBudget& memory) {
    constexpr size_t kStep = 1 << 20;
    Inflater inflater;
    z_stream& stream = inflater.stream();
    std::vector<uint8_t> content, step(kStep);
    int state = Z_OK;
    while (state != Z_STREAM_END) {
        if (stream.avail_in == 0) {
            const size_t count = std::min<size_t>(bytes.size(), std::numeric_limits<uInt>::max());
            stream.next_in = const_cast<Bytef*>(bytes.data());
            stream.avail_in = uInt(count);
            bytes = bytes.subspan(count);
        }
        stream.next_out = step.data();
        stream.avail_out = uInt(kStep);
        state = inflate(&stream, Z_NO_FLUSH);
        const size_t count = kStep - stream.avail_out;
        memory.reserve(count, 1);
        content.insert(content.end(), step.begin(), step.begin() + ptrdiff_t(count));
        if (state == Z_BUF_ERROR) throw Error("its compressed data is truncated");
        if (state != Z_OK && state != Z_STREAM_END) throw Error("its compressed data is broken");
    }
    return content;
}

}  // namespace voxray
