#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/manifest.h"
#include "experiment/runner.h"
#include "experiment/session.h"

namespace voxray {

/// Prepares the scene of each variant, plans its graph and the reference's on it and does all checks
/// (checks/checks.h), so that mistakes are reported before anything is rendered. The memory of the device is
/// not checked. Sets Study::warnings and masks, Variant::sceneKey and memory.
/// @param onlyVariant index of a single variant to plan; checks of all variants together are skipped, and no memory
/// is set.
/// @throws UsageError with file and line: for a scene as SceneLoader::prepare(); for parameters that a pass
/// rejects; if all variants exceed the config's limit of memory; for settings of the scene that have no
/// effect in any variant.
void planVariants(Study& study, SceneLoader& loader, CameraViewChecks& viewChecks, const DeviceInfo& device,
                  std::optional<size_t> onlyVariant = std::nullopt);

/// An experiment that was planned and checked on a device: the input of a run and of each of its parts.
class PreparedExperiment {
 public:
    /// @throws UsageError as runExperiment(), Interrupted.
    PreparedExperiment(Study study, const RunOptions& options);
    PreparedExperiment(const PreparedExperiment&) = delete;
    PreparedExperiment& operator=(const PreparedExperiment&) = delete;

    const Study& study() const { return study_; }
    const Experiment& experiment() const { return study_.experiment; }
    std::vector<Variant>& variants() { return study_.variants; }
    const std::vector<Variant>& variants() const { return study_.variants; }
    const RunOptions& options() const { return options_; }
    Session& session() { return *session_; }

    /// Data of the manifest that is known before anything is rendered, without warnings.
    const ManifestData& manifest() const { return manifest_; }
    /// All warnings so far, including those of the session.
    std::vector<std::string> warnings() const;

    /// All inputs that a variant's result depends on.
    VariantInputs inputsOf(const Variant& variant);

 private:
    /// Sets manifest_.
    void recordInputs();
    /// The variant of the part that the options name; nullopt if all variants are needed.
    std::optional<size_t> selectedVariant();

    Study study_;
    const RunOptions& options_;
    std::optional<Session> session_;
    ManifestData manifest_;
};

}  // namespace voxray
