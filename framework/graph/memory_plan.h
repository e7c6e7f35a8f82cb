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
};

/// The device memory that a pass needs. Each buffer or image is described once, together with the member that
/// will hold it: the graph predicts its bytes, makes it and frees it. What can be sized only by counting on
/// the device is reserved, and the pass makes it itself.
class MemoryPlan {
 public:
    /// A buffer of the pass or of one of its outputs: there from before prepare() on. `target` must stay
    /// where it is for as long as the graph exists; a T that is derived from Buffer has a constructor like
    /// Buffer's.
    template <std::derived_from<Buffer> T>
    void buffer(T& target, std::string name, uint64_t bytes) {
        add(Part::Kept, bytes, target, std::move(name), bytes);
    }
    /// The same for an image.
    void image(Image& target, std::string name, const ImageDesc& desc) {
        add(Part::Kept, imageBytes(desc), target, std::move(name), desc);
    }
    /// A buffer that exists only while the pass records; its content is undefined each time.
    template <std::derived_from<Buffer> T>
    void scratchBuffer(T& target, std::string name, uint64_t bytes) {
        add(Part::Scratch, bytes, target, std::move(name), bytes);
    }

    /// Bytes that the pass will allocate itself, under `name`, and keep: an upper bound. A pass that keeps
    /// more fails when it prepares or records.
    void reserve(std::string name, uint64_t bytes) {
        parts_.push_back({std::move(name), bytes, Part::Kept, {}, {}});
    }
    /// Bytes that it will allocate itself and keep, of which it knows about how many before it has counted on
    /// the device: it may keep as many more as PassContext::spareBytes tells.
    void reserveCounted(std::string name, uint64_t bytes) {
        parts_.push_back({std::move(name), bytes, Part::Counted, {}, {}});
    }
    /// Bytes that it will allocate and free again while it records: an upper bound. A pass with stages
    /// reserves what the largest of them takes.
    void reserveScratch(std::string name, uint64_t bytes) {
        parts_.push_back({std::move(name), bytes, Part::Scratch, {}, {}});
    }

    /// A described buffer or image, or a reservation.
    struct Part {
        enum Kind { Kept, Counted, Scratch };
        std::string name;
        uint64_t bytes;
        Kind kind;
        std::function<void(Device&)> make;  ///< Empty for a reservation, as is `free`.
        std::function<void()> free;
    };
    const std::vector<Part>& parts() const { return parts_; }

 private:
    template <typename T, typename Size>
    void add(Part::Kind kind, uint64_t bytes, T& target, std::string name, const Size& size) {
        const auto make = [&target, name, size](Device& device) {
            target = T();  // The previous one goes first.
            target = T(device, name, size);
        };
        parts_.push_back({std::move(name), bytes, kind, make, [&target] { target = T(); }});
    }

    std::vector<Part> parts_;
};

}  // namespace voxray
