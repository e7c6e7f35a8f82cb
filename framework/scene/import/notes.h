#pragma once

#include <map>
#include <string>
#include <vector>

namespace voxray {

/// What a reader of scenes approximated or left out: one warning for each kind, with the names that it concerns.
class ImportNotes {
 public:
    /// @param kind what became of it, as "'bumpmap' is left out". @param name of the thing, may be empty
    void add(const std::string& kind, const std::string& name);

    /// "KIND: 'NAME', 'NAME' and 7 more", in the order of the first of each kind.
    std::vector<std::string> lines() const;

 private:
    struct Entry {
        std::string kind;
        std::vector<std::string> names;  ///< The first few that differ.
        size_t count = 0;
    };
    std::vector<Entry> entries_;
    std::map<std::string, size_t> numbers_;
};

}  // namespace voxray
