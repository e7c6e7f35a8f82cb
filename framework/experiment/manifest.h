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

/// A reference whose images lie in a results folder.
struct ReferenceEntry {
    std::string folder;  ///< Below images/.
    std::string hash;
    std::string text;  ///< Of its reference.json.
};

/// When each process that measured variants began (VariantResult::session) -> these variants.
using Sessions = std::map<std::string, std::vector<std::string>>;

Sessions sessionsOf(const std::vector<VariantResult>& results);

/// What `manifest.json` records.
struct ManifestData {
    const Study* study = nullptr;  ///< With sceneKey and referenceHash of its variants.
    Value referencePass;           ///< With every default filled in; null: none.
    DeviceInfo device;
    std::string requestedDevice;  ///< Empty: the best.
    std::string tracer;           ///< Of the first variant.
    bool validation = false;
    std::string version, commit;
    std::string started, finished;  ///< UTC, ISO 8601; `finished` is empty until the run is.
    Sessions sessions;
    std::vector<ReferenceEntry> references;
    std::vector<std::string> warnings;  ///< What may make a result misleading.
    std::vector<std::string> notes;     ///< What a reader may want to know besides.
};

/// @return the text of manifest.json.
std::string manifestJson(const ManifestData& data);

/// A hash of what results of one experiment have in common: config, version, scenes and references. It stands
/// first in the manifest, so that a part can tell whose folder it writes into without reading the rest.
std::string identityOf(const ManifestData& data);

/// @return the text of reference.json, which lies with a reference's images.
/// @param pass with every default filled in.
std::string referenceJson(const ReferenceRecord& record, const Value& pass);
/// Reads the references below images/, in the order of their folders; what isn't whole is left out.
std::vector<ReferenceEntry> referencesIn(const std::filesystem::path& images);

/// The identity, and the name of the experiment, in a manifest's text; "" where there is none.
std::string identityIn(const std::string& manifest);
std::string experimentIn(const std::string& manifest);

/// A manifest's text, read. @throws Error for text that manifestJson didn't write.
nlohmann::ordered_json parseManifest(const std::string& text);

/// What keeps results of two manifests from being those of one experiment: config, version or scenes, as
/// "config.seed: 7 and 8"; empty where nothing does.
std::string manifestDifference(const nlohmann::ordered_json& first, const nlohmann::ordered_json& second);

/// The manifest of results that were put together. @param first one of theirs.
/// @param warnings, notes of all of them. @param isWhole whether no variant is missing.
std::string mergedManifest(nlohmann::ordered_json first, const std::vector<ReferenceEntry>& references,
                           const Sessions& sessions, const std::vector<std::string>& warnings,
                           const std::vector<std::string>& notes, bool isWhole);

/// The commit that a source folder has checked out, "unknown" outside of git.
std::string commitOf(const std::filesystem::path& sourceRoot);

/// Now, UTC, ISO 8601.
std::string utcNow();

}  // namespace voxray
