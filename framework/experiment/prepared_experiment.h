#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/manifest.h"
#include "experiment/runner.h"
#include "experiment/session.h"

namespace voxray {

/// An experiment on a device, checked, before anything is rendered: where a run and each of its parts begin.
class PreparedExperiment {
 public:
    /// @throws UsageError as runExperiment(), Interrupted.
    PreparedExperiment(WiredExperiment experiment, const RunOptions& options, const Registry& registry);
    PreparedExperiment(const PreparedExperiment&) = delete;
    PreparedExperiment& operator=(const PreparedExperiment&) = delete;

    const Experiment& experiment() const { return wired_.experiment; }
    const WiredExperiment& wired() const { return wired_; }
    std::vector<WiredVariant>& variants() { return wired_.variants; }
    const RunOptions& options() const { return options_; }
    const Registry& registry() const { return registry_; }
    Session& session() { return *session_; }

    /// What is to be recorded, as far as it is known before anything is rendered. No warnings: they grow.
    const ManifestData& manifest() const { return manifest_; }
    /// What may make a result misleading, the session's so far among it.
    std::vector<std::string> warnings() const;

    /// The hash of a variant's reference, "" where the experiment has none.
    const std::string& referenceHash(const WiredVariant& variant) const {
        return manifest_.referenceHashes.at(variant.name);
    }
    /// What a variant's result depends on.
    VariantInputs inputsOf(const WiredVariant& variant);

 private:
    void recordInputs();
    /// The variant of the part that the options name; none where all variants are needed.
    std::optional<size_t> ownVariant();

    WiredExperiment wired_;
    const RunOptions& options_;
    const Registry& registry_;
    std::optional<Session> session_;
    ManifestData manifest_;
    std::vector<std::string> warnings_;  ///< More than the session's own.
};

}  // namespace voxray
