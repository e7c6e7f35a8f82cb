#pragma once

#include <any>
#include <map>
#include <string>

namespace voxray {

/// What plans found out about a scene, kept for the plans of other variants of the same scene: to count
/// voxels takes as long as all else in a plan.
class PlanMemo {
 public:
    /// The answer of `find` for `key`, which names all that it depends on but for the scene.
    template <typename Find>
    auto get(const std::string& key, const Find& find) {
        std::any& answer = answers_[key];
        if (!answer.has_value()) answer = find();
        return std::any_cast<decltype(find())>(answer);
    }

 private:
    std::map<std::string, std::any> answers_;
};

}  // namespace voxray
