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

/// Renders parts of an experiment into a results folder, one after the other: all of them in a run.
class PartRunner {
 public:
    /// Both must outlive this object.
    PartRunner(PreparedExperiment& prepared, const ResultsFolder& folder);

    /// Renders, measures and scores a variant and writes its images with its result, whole, and those of its
    /// reference where they aren't there. What throws is a failed result that is not written.
    /// @return false where it was interrupted, and has no result. @throws Error where the folder can't be
    /// written.
    bool runVariant(Variant& variant, Progress& progress);

    /// Renders a part of a reference and writes its sums. @throws Error, Interrupted.
    void runReference(const Part& part, Progress& progress);

    /// Whether the images of a variant's reference are in the folder, or it has none.
    bool hasReferenceImages(const Variant& variant) const;
    /// Removes the references in the folder: of an older run of which nothing is kept, and whose masks may
    /// have been others.
    void dropReferences();
    /// The references whose images are in the folder.
    const std::vector<ReferenceEntry>& references() const { return references_; }
    /// The experiment's and those that came up here.
    std::vector<std::string> warnings() const;
    /// Prints warnings that it has not printed yet.
    void printWarnings(Progress& progress);
    /// Prints messages of the Vulkan validation layer. @return how many there are by now.
    size_t printValidationMessages(Progress& progress);

 private:
    const PreparedReference* referenceOf(const Variant& variant, Progress& progress);
    VariantImages render(Variant& variant, const PreparedReference* reference, Progress& progress);
    std::string referenceFolder(const std::string& hash) const;
    void writeReference(const Variant& variant, Progress& progress);

    PreparedExperiment& prepared_;
    const ResultsFolder& folder_;
    std::vector<ReferenceEntry> references_;
    std::optional<PreparedReference> reference_;  ///< The last one.
    std::vector<std::string> warnings_;           ///< More than the experiment's.
    std::set<std::string> printed_;               ///< Of the warnings.
    size_t messages_ = 0;                         ///< Of the validation layer, printed.
};

}  // namespace voxray
