#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "experiment/reference.h"
#include "experiment/results.h"
#include "experiment/study.h"
#include "vulkan/device.h"

namespace voxray {

/// A reference with the scores of a black and of a constant image against it.
struct ReferenceRecord {
    /// Below images/: "reference"; with several references also "reference.2" and so on.
    std::string folder;
    std::string hash;
    double seconds = 0;
    bool cached = false;
    Scores noise;  ///< Expected scores of a perfect image, by column, for metrics that depend on noise.
    FlipExposures exposures, indirectExposures;
    Scores black, constant;                       ///< By column.
    std::map<std::string, double> maskFractions;  ///< Fraction of pixels that each mask selects.
};

/// A reference whose images are in a results folder.
struct ReferenceEntry {
    std::string folder;  ///< Below images/.
    std::string hash;
    std::string text;  ///< Contents of its reference.json.
};

/// Variants by the start time of the process that measured them (VariantResult::session).
using Sessions = std::map<std::string, std::vector<std::string>>;

Sessions sessionsOf(const std::vector<VariantResult>& results);

/// Contents of `manifest.json`.
struct ManifestData {
    const Study* study = nullptr;  ///< With sceneKey and referenceHash of its variants.
    Value referencePass;           ///< Including all default values; null: none.
    DeviceInfo device;
    std::string requestedDevice;  ///< Empty: the best.
    std::string tracer;           ///< That of the first variant.
    bool validation = false;
    std::string version, commit;
    std::string started, finished;  ///< UTC, ISO 8601; `finished` is empty until the run has finished.
    Sessions sessions;
    std::vector<ReferenceEntry> references;
    std::vector<std::string> warnings;  ///< Reasons why results may be misleading.
    std::vector<std::string> notes;     ///< Other information for readers.
};

/// @return the text of manifest.json.
std::string manifestJson(const ManifestData& data);

/// A hash of everything that all results of an experiment have in common: config, version, scenes and
/// references. It is the first key of the manifest, so that it can be read without parsing the rest.
std::string identityOf(const ManifestData& data);

/// @return the text of reference.json, which is stored with a reference's images.
/// @param pass including all default values.
std::string referenceJson(const ReferenceRecord& record, const Value& pass);
/// Reads the references below images/ in the order of their folders. Incomplete ones are skipped.
std::vector<ReferenceEntry> referencesIn(const std::filesystem::path& images);

/// The identity and the experiment's name in the text of a manifest; "" if there is none.
std::string identityIn(const std::string& manifest);
std::string experimentIn(const std::string& manifest);

/// Parses the text of a manifest. @throws Error for text that manifestJson() didn't write.
nlohmann::ordered_json parseManifest(const std::string& text);

/// The first difference in config, version or scenes by which two manifests belong to different experiments,
/// as in "config.seed: 7 and 8"; empty if there is none.
std::string manifestDifference(const nlohmann::ordered_json& first, const nlohmann::ordered_json& second);

/// The manifest of merged results. @param first one of their manifests.
/// @param warnings, notes of all of them. @param isWhole whether no variant is missing.
std::string mergedManifest(nlohmann::ordered_json first, const std::vector<ReferenceEntry>& references,
                           const Sessions& sessions, const std::vector<std::string>& warnings,
                           const std::vector<std::string>& notes, bool isWhole);

/// The commit that is checked out in a source folder; "unknown" outside of git.
std::string commitOf(const std::filesystem::path& sourceRoot);

/// The current time in UTC, ISO 8601.
std::string utcNow();

}  // namespace voxray
