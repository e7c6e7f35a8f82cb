#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/manifest.h"
#include "experiment/runner.h"
#include "experiment/session.h"

namespace voxray {

/// Prepares the scene of every variant, plans its graph and the reference's there and does all checks
/// (checks/checks.h), so that mistakes show before anything is rendered. How much memory the device has does
/// not count. Fills in Study::warnings and masks, Variant::sceneKey and memory.
/// @param only the index of the variant to look at alone; what can be said of all variants together is left
/// out, and no memory is filled in.
/// @throws UsageError with file and line: for a scene as SceneLoader::prepare(); for what a pass refuses;
/// where all variants are over the limit of memory; for settings of the scene without effect in all variants
/// that have them.
void planVariants(Study& study, SceneLoader& loader, ViewChecks& views, const DeviceInfo& device,
                  std::optional<size_t> only = std::nullopt);

/// An experiment on a device, checked, before anything is rendered: where a run and each of its parts begin.
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

    /// What is to be recorded, as far as it is known before anything is rendered. No warnings: they grow.
    const ManifestData& manifest() const { return manifest_; }
    /// What may make a result misleading, the session's so far among it.
    std::vector<std::string> warnings() const;

    /// What a variant's result depends on.
    VariantInputs inputsOf(const Variant& variant);

 private:
    void recordInputs();
    /// The variant of the part that the options name; none where all variants are needed.
    std::optional<size_t> ownVariant();

    Study study_;
    const RunOptions& options_;
    std::optional<Session> session_;
    ManifestData manifest_;
};

}  // namespace voxray
