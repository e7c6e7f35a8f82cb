#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/progress.h"
#include "experiment/parts.h"
#include "experiment/prepared_experiment.h"
#include "experiment/results_folder.h"
#include "experiment/variant_run.h"

namespace voxray {

/// Renders parts of an experiment into a results folder, one after another.
class PartRunner {
 public:
    /// Both must outlive this object.
    PartRunner(PreparedExperiment& prepared, const ResultsFolder& folder);

    /// Renders, measures and scores a variant and writes its images and its result atomically, and those of
    /// its reference unless they exist. Errors of the variant become a failed result, which is not written.
    /// @return false if it was interrupted and has no result. @throws Error if the folder can't be written.
    bool runVariant(Variant& variant, Progress& progress);

    /// Renders a part of a reference and writes its sums of samples. @throws Error, Interrupted.
    void runReference(const Part& part, Progress& progress);

    /// Whether the images of a variant's reference are in the folder, or it has none.
    bool hasReferenceImages(const Variant& variant) const;
    /// Removes all references in the folder, e.g. those of an older run with other masks.
    void dropReferences();
    /// The references whose images are in the folder.
    const std::vector<ReferenceEntry>& references() const { return references_; }
    /// Warnings of the experiment and of its parts so far.
    std::vector<std::string> warnings() const;
    /// Prints warnings that it has not printed yet.
    void printWarnings(Progress& progress);
    /// Prints new messages of the Vulkan validation layer. @return the number of all messages so far.
    size_t printValidationMessages(Progress& progress);

 private:
    const PreparedReference* referenceOf(const Variant& variant, Progress& progress);
    VariantImages render(Variant& variant, const PreparedReference* reference, Progress& progress);
    std::string referenceFolder(const std::string& hash) const;
    void writeReference(const Variant& variant, Progress& progress);

    PreparedExperiment& prepared_;
    const ResultsFolder& folder_;
    std::vector<ReferenceEntry> references_;
    std::optional<PreparedReference> reference_;  ///< That of the last variant.
    std::vector<std::string> warnings_;           ///< In addition to those of the experiment.
    std::set<std::string> printed_;               ///< Warnings that were printed.
    size_t messages_ = 0;                         ///< Number of validation messages that were printed.
};

}  // namespace voxray
