#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "config/config.h"
#include "experiment/reference.h"
#include "experiment/results.h"
#include "vulkan/device.h"

namespace voxray {

/// A reference, and what a black and a constant image score against it.
struct ReferenceRecord {
    std::string
        folder;  ///< Below images/: "reference", then "reference.2" and so on where variants need several.
    std::string hash;
    double seconds = 0;
    bool cached = false;
    Scores noise;  ///< What a perfect image is expected to score, by column, where noise counts.
    FlipExposures exposures, indirectExposures;
    Scores black, constant;                       ///< By column.
    std::map<std::string, double> maskFractions;  ///< By mask: of the image's pixels, those that it selects.
};

/// What `manifest.json` records.
struct ManifestData {
    const Experiment* experiment = nullptr;
    std::vector<std::pair<std::string, Value>>
        graphs;  ///< Variant -> its passes with every default filled in.
    /// Image ("final", "indirect") -> variant -> what lowers its noise there (noiseParameters()).
    std::map<std::string, std::map<std::string, std::vector<std::string>>> noiseParameters;
    Value referencePass;  ///< With every default filled in; null: none.
    DeviceInfo device;
    std::string requestedDevice;  ///< Empty: the best.
    std::string tracer;           ///< Of the first variant.
    bool validation = false;
    std::string version, commit;
    std::string started, finished;  ///< UTC, ISO 8601; `finished` is empty until the run is.
    /// Start of each process that measured variants, as `started` -> these variants.
    std::map<std::string, std::vector<std::string>> sessions;
    std::vector<ReferenceRecord> references;
    std::map<std::string, std::string> referenceHashes;  ///< Variant -> its reference's hash.
    std::vector<std::string> warnings;                   ///< What may make a result misleading.
    std::vector<std::string> notes;                      ///< What a reader may want to know besides.
};

/// @return the text of manifest.json.
std::string manifestJson(const ManifestData& data);

/// The references that an older manifest records; empty for text that manifestJson didn't write.
std::vector<ReferenceRecord> referencesOf(const std::string& manifestText);

/// The commit that a source folder has checked out, "unknown" outside of git.
std::string commitOf(const std::filesystem::path& sourceRoot);

/// Now, UTC, ISO 8601.
std::string utcNow();

}  // namespace voxray
