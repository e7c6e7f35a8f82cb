#include "scene/import/notes.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/one_line.h"

namespace voxray {
namespace {

constexpr size_t kNotedNames = 5;
constexpr size_t kNotedKinds = 100;  ///< A broken file may have a kind for each of its bytes.

}  // namespace

void ImportNotes::add(const std::string& kind, const std::string& name) {
    const std::string line = oneLine(kind, 300);
    if (entries_.size() >= kNotedKinds && !numbers_.contains(line)) return;
    const auto [number, added] = numbers_.try_emplace(line, entries_.size());
    if (added) entries_.push_back({line, {}, 0});
    Entry& entry = entries_[number->second];
    const std::string shown = oneLine(name, 100);
    if (std::ranges::count(entry.names, shown) > 0) return;
    ++entry.count;
    if (entry.names.size() < kNotedNames) entry.names.push_back(shown);
}

std::vector<std::string> ImportNotes::lines() const {
    std::vector<std::string> lines;
    for (const Entry& entry : entries_) {
        std::string line = entry.kind;
        const char* separator = ": ";
        for (const std::string& name : entry.names) {
            if (name.empty()) continue;
            line += fmt::format("{}'{}'", separator, name);
            separator = ", ";
        }
        if (entry.count > entry.names.size()) line += fmt::format(" and {} more", entry.count - entry.names.size());
        lines.push_back(line);
    }
    return lines;
}

}  // namespace voxray
