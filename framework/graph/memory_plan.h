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
    uint64_t bytes = 0;           ///< Persistent, including its outputs.
    uint64_t scratchBytes = 0;    ///< Peak of additional memory while it records.
    uint64_t estimatedBytes = 0;  ///< In a plan: estimate of persistent memory sized on the device.
};

/// The device memory of a pass, as far as it is known before the pass runs. Each buffer or image is described
/// once, with the member that will hold it; the graph sums up their bytes, makes and frees them. Buffers
/// sized by a count from the device are made by the pass in record(): an allocation over the memory limit
/// throws, and the graph adds the pass and what to lower.
class MemoryPlan {
 public:
    /// A persistent buffer of the pass or one of its outputs, made before prepare(). `target` must not move
    /// while the graph exists; a T derived from Buffer needs a constructor like Buffer's.
    template <std::derived_from<Buffer> T>
    void buffer(T& target, std::string name, uint64_t bytes) {
        add(false, bytes, target, std::move(name), bytes);
    }
    /// The same for an image.
    void image(Image& target, std::string name, const ImageDesc& desc) {
        add(false, imageBytes(desc), target, std::move(name), desc);
    }
    /// A buffer that exists only while the pass records; its contents are undefined each time.
    template <std::derived_from<Buffer> T>
    void scratchBuffer(T& target, std::string name, uint64_t bytes) {
        add(true, bytes, target, std::move(name), bytes);
    }
    /// Estimated bytes of what the pass sizes while it records; for `--dry-run` and shares of machines only.
    void estimate(double bytes) { estimatedBytes_ += uint64_t(bytes); }

    /// A described buffer or image.
    struct Allocation {
        std::string name;
        uint64_t bytes;
        bool isScratch;
        std::function<void(Device&)> make;
        std::function<void()> free;
    };
    const std::vector<Allocation>& allocations() const { return allocations_; }
    uint64_t estimatedBytes() const { return estimatedBytes_; }

 private:
    template <typename T, typename Size>
    void add(bool isScratch, uint64_t bytes, T& target, std::string name, const Size& size) {
        const auto make = [&target, name, size](Device& device) {
            target = T();  // Frees the previous one first.
            target = T(device, name, size);
        };
        allocations_.push_back({std::move(name), bytes, isScratch, make, [&target] { target = T(); }});
    }

    std::vector<Allocation> allocations_;
    uint64_t estimatedBytes_ = 0;
};

}  // namespace voxray
