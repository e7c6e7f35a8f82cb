#include "vulkan/program_cache.h"

#include <utility>

namespace voxray {
namespace {

/// A larger cache is rid of programs that nothing uses.
constexpr size_t kMaxPrograms = 512;

}  // namespace

std::shared_ptr<const Program> ProgramCache::get(const std::string& key, const std::function<Program()>& make) {
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
    }
    // Unlocked, so that programs are made in parallel; of two equal ones the first is stored.
    auto made = std::make_shared<const Program>(make());
    const std::lock_guard lock(mutex_);
    if (programs_.size() >= kMaxPrograms)
        std::erase_if(programs_, [](const auto& entry) { return entry.second.use_count() == 1; });
    return programs_.emplace(key, std::move(made)).first->second;
}

}  // namespace voxray
