#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "vulkan/memory.h"

namespace voxray {

/// Device memory of one pass.
struct PassMemory {
    uint64_t bytes = 0;         ///< That it keeps, its outputs among it.
    uint64_t scratchBytes = 0;  ///< That it takes besides while it records, at most.
    /// In a plan: about what it will keep besides, which only counting on the device can tell.
    uint64_t estimatedBytes = 0;
};

/// The device memory that a pass needs, as far as it is known before the pass runs. Each buffer or image is
/// described once, together with the member that will hold it: the graph sums up its bytes, makes it and
/// frees it. What is sized by counting on the device the pass makes in record(): the device refuses what the
/// limit doesn't leave, and the graph adds which pass it was and what to lower.
class MemoryPlan {
 public:
    /// A buffer of the pass or of one of its outputs: there from before prepare() on. `target` must stay
    /// where it is for as long as the graph exists; a T that is derived from Buffer has a constructor like
    /// Buffer's.
    template <std::derived_from<Buffer> T>
    void buffer(T& target, std::string name, uint64_t bytes) {
        add(false, bytes, target, std::move(name), bytes);
    }
    /// The same for an image.
    void image(Image& target, std::string name, const ImageDesc& desc) {
        add(false, imageBytes(desc), target, std::move(name), desc);
    }
    /// A buffer that exists only while the pass records; its content is undefined each time.
    template <std::derived_from<Buffer> T>
    void scratchBuffer(T& target, std::string name, uint64_t bytes) {
        add(true, bytes, target, std::move(name), bytes);
    }
    /// About how many bytes the pass will keep of what it counts while it records: for `--dry-run` and shares
    /// of machines alone.
    void estimate(double bytes) { estimatedBytes_ += uint64_t(bytes); }

    /// A described buffer or image.
    struct Part {
        std::string name;
        uint64_t bytes;
        bool isScratch;
        std::function<void(Device&)> make;
        std::function<void()> free;
    };
    const std::vector<Part>& parts() const { return parts_; }
    uint64_t estimatedBytes() const { return estimatedBytes_; }

 private:
    template <typename T, typename Size>
    void add(bool isScratch, uint64_t bytes, T& target, std::string name, const Size& size) {
        const auto make = [&target, name, size](Device& device) {
            target = T();  // The previous one goes first.
            target = T(device, name, size);
        };
        parts_.push_back({std::move(name), bytes, isScratch, make, [&target] { target = T(); }});
    }

    std::vector<Part> parts_;
    uint64_t estimatedBytes_ = 0;
};

}  // namespace voxray
