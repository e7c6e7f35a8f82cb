#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace voxray {

class Buffer;
class Image;

/// The images, and the buffers of MemoryKind::Device, that exist on a device, each with whoever made it.
class LiveMemory {
 public:
    struct Entry {
        uint64_t maker = 0;
        const Buffer* buffer = nullptr;  ///< Or else:
        const Image* image = nullptr;
    };

    /// From 1; 0 is nobody.
    uint64_t newMaker() { return ++makers_; }
    /// What is made while it lives has this maker; before and after, the one before.
    class Making {
     public:
        Making(LiveMemory& live, uint64_t maker) : live_(live), before_(live.maker_) { live_.maker_ = maker; }
        ~Making() { live_.maker_ = before_; }
        Making(const Making&) = delete;
        Making& operator=(const Making&) = delete;

     private:
        LiveMemory& live_;
        const uint64_t before_;
    };
    /// What a maker made, in the order in which it was made; nothing for nobody.
    std::vector<Entry> madeBy(uint64_t maker) const {
        std::vector<Entry> made;
        for (const auto& [number, entry] : entries_)
            if (maker != 0 && entry.maker == maker) made.push_back(entry);
        return made;
    }

    // Called by Buffer and Image
    /// @return the entry's number, from 1.
    uint64_t add(const Buffer* buffer, const Image* image) {
        entries_.emplace(++numbers_, Entry{maker_, buffer, image});
        return numbers_;
    }
    /// Nothing for an entry that is not there.
    void move(uint64_t number, const Buffer* buffer, const Image* image) noexcept {
        const auto found = entries_.find(number);
        if (found == entries_.end()) return;
        found->second.buffer = buffer;
        found->second.image = image;
    }
    void remove(uint64_t number) noexcept { entries_.erase(number); }

 private:
    std::map<uint64_t, Entry> entries_;  ///< By number.
    uint64_t numbers_ = 0, makers_ = 0, maker_ = 0;
};

}  // namespace voxray
