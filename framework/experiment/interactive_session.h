#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/runner.h"
#include "experiment/session.h"
#include "experiment/shown_state.h"

namespace voxray {

/// A config that stays open on a device. It shows one state, or two side by side: both share device, scenes, ray
/// tracers and compiler; what build passes wrote is kept for each.
class InteractiveSession {
 public:
    static constexpr size_t kSides = 2;

    /// Opens the first variant of the experiment on side 0. @param registry must outlive the session.
    /// @param leftOut names of variants that are not offered; not of all. @throws UsageError as makeStudy() and
    /// planVariants().
    InteractiveSession(Experiment experiment, const Registry& registry, const RunOptions& options,
                       const std::vector<std::string>& leftOut = {});
    InteractiveSession(const InteractiveSession&) = delete;
    InteractiveSession& operator=(const InteractiveSession&) = delete;

    /// Names and ids of the experiment's variants as it was opened.
    const std::vector<std::pair<std::string, std::string>>& variants() const { return variants_; }
    /// The id and the config of a variant, by its id or its name. @throws UsageError if there is no such variant.
    const std::string& idOf(const std::string& variant) const;
    const Value& configOf(const std::string& variant) const;

    /// Side 0 or 1. Side 1 begins with the values that side 0 has when it is first asked for.
    ShownState& side(size_t number);
    bool isOpen(size_t side) const { return sides_.at(side).has_value(); }
    /// Frees what side 1 holds; it begins anew when it is asked for again.
    void closeSecondSide();

    /// Renders more of the sides' references, of one after the other, as ProgressiveReference::advance(). One that
    /// fails is left alone (ProgressiveReference::hasFailed()). @return whether samples are missing. @throws
    /// Interrupted.
    bool advanceReferences(std::chrono::milliseconds budget);

    // For the states
    /// Makes the study of a config without sweep. @throws UsageError
    Study studyOf(Value config) const;
    /// The same, checked against scene and device. Where only the camera or the image differ from a study that was
    /// checked just before, a new view is not path traced for what may mislead.
    Study checkedStudy(Value config);
    Session& resources() { return session_; }
    /// As configOf(), without time where only scenes of other variants are animated. Loads the scene to know.
    const Value& configAlone(const std::string& variant);
    /// The reference of a side's study, which sides with the same one share.
    ProgressiveReference& reference(const Study& study);
    /// Frees references of which no side has the study any more.
    void dropReferences();

 private:
    size_t indexOf(const std::string& variant) const;
    void leaveOutIdleTime(Value& config);
    bool isShown(const ProgressiveReference& reference) const;

    const Registry& registry_;
    const Experiment opened_;
    Session session_;
    CameraViewChecks viewChecks_;
    std::vector<std::string> checkedScenes_;  ///< SceneOnDevice::cameraless of the last checked studies, a side each.
    std::vector<std::string> idlePasses_;     ///< Ids of passes that are culled in some variants and run in others.
    std::vector<std::pair<std::string, std::string>> variants_;  ///< Name and id.
    std::vector<Value> variantConfigs_;
    bool sweepsScene_ = false;
    std::array<std::optional<ShownState>, kSides> sides_;
    std::array<std::optional<ProgressiveReference>, kSides> references_;
};

}  // namespace voxray
