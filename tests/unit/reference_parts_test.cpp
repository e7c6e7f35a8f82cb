#include <nlohmann/json.hpp>

#include "experiment/merge.h"
#include "experiment/parts.h"
#include "experiment_fakes.h"
#include "tests/support/errors.h"

using namespace voxray;
using namespace voxray::fakes;
namespace fs = std::filesystem;

/// Runs in parts, on fakes with closed forms: the reference is 1 everywhere.
class RunInParts : public RunTest {
 protected:
    static constexpr const char* kSweep = "sweep: {constant.value: [1, 0.5]}\n";

    std::vector<Part> parts(uint32_t referenceParts, const std::string& rest = kSweep) const {
        const Registry passes = registry();
        const RunOptions o = options();
        PreparedExperiment prepared(makeStudy(parseExperiment(config(rest), "fake.yaml"), passes), o);
        return partsOf(prepared, referenceParts);
    }
    RunSummary runPart(const std::string& id, const std::string& out = "out", const std::string& rest = kSweep) const {
        RunOptions o = options();
        o.out = root_ / out;
        o.part = id;
        return run(rest, o);
    }
    RunSummary merge(const std::vector<std::string>& folders, const std::string& out) const {
        std::vector<fs::path> paths;
        for (const std::string& folder : folders) paths.push_back(root_ / folder);
        return mergeResults(paths, root_ / out, options());
    }
    void useCache(const std::string& name) const { setenv("VOXRAY_CACHE", (root_ / name).c_str(), 1); }
};

TEST_F(RunInParts, PartsAreListedInOrder) {
    const std::vector<Part> all = parts(2);
    ASSERT_EQ(all.size(), 5u);
    EXPECT_TRUE(all[0].id.ends_with(".1-of-2")) << all[0].id;
    EXPECT_EQ(all[2].id, "variant.value-1");
    EXPECT_EQ(all[2].after, (std::vector<std::string>{all[0].id, all[1].id}));
    EXPECT_EQ(all[4].id, "merge");
    EXPECT_EQ(all[4].after, (std::vector<std::string>{"variant.value-1", "variant.value-0.5"}));

    // What the sweep has besides changes no id, another reference does
    EXPECT_EQ(parts(2, "sweep: {constant.value: [0.25, 1]}\n")[0].id, all[0].id);
    EXPECT_NE(parts(2, std::string(kSweep) + "seed: 3\n")[0].id, all[0].id);
    EXPECT_EQ(parts(1, "sweep: {image.width: [8, 16]}\n").size(), 5u);
    EXPECT_CONTAINS(errorOf<UsageError>([&] { parts(5); }), "4 samples a pixel can't be divided into 5 parts");
}

TEST_F(RunInParts, InAnyOrderTheyMakeWhatARunMakes) {
    run(kSweep);
    const std::string right = cell("value-0.5", "nrmse");
    const auto rightManifest = nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json"));
    useCache("other-cache");
    Truth::runs = 0;
    const std::vector<Part> all = parts(3);
    for (const size_t i : {2u, 0u, 1u, 4u, 3u}) {
        EXPECT_EQ(runPart(all[i].id, "parts-out").exitStatus(), 0) << all[i].id;
        EXPECT_TRUE(fs::exists(root_ / "parts-out" / all[i].writes)) << all[i].writes;
    }
    EXPECT_EQ(Truth::runs, 3);
    EXPECT_FALSE(fs::exists(root_ / "parts-out" / "results.csv"));
    const RunSummary merged = runPart("merge", "parts-out");
    EXPECT_EQ(merged.exitStatus(), 0);
    EXPECT_EQ(merged.ok, 2u);

    fs::remove_all(root_ / "out");
    fs::rename(root_ / "parts-out", root_ / "out");
    EXPECT_EQ(cell("value-0.5", "nrmse"), right);
    const auto manifest = nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json"));
    for (const char* key : {"config", "inputs", "baselines", "variants", "warnings", "notes"})
        EXPECT_EQ(manifest[key], rightManifest[key]) << key;
    EXPECT_EQ(manifest["references"][0]["variants"], rightManifest["references"][0]["variants"]);
    EXPECT_TRUE(manifest["finished"].is_string());
    EXPECT_FALSE(fs::exists(root_ / "out" / ".lock"));
}

TEST_F(RunInParts, AVariantWaitsForItsReference) {
    EXPECT_CONTAINS(errorOf<UsageError>([&] { runPart("variant.value-1"); }), "it comes after all parts of");
    const std::vector<Part> all = parts(2);
    runPart(all[0].id);
    EXPECT_THROW(runPart("variant.value-1"), UsageError);
    runPart(all[1].id);
    EXPECT_EQ(runPart("variant.value-1").exitStatus(), 0);
    EXPECT_EQ(Truth::runs, 2);

    // From now on it is in the cache, for a part that is the whole of it, too
    EXPECT_EQ(runPart("variant.value-0.5", "elsewhere").exitStatus(), 0);
    EXPECT_EQ(runPart(parts(1)[0].id, "elsewhere").exitStatus(), 0);
    EXPECT_EQ(Truth::runs, 2);
}

TEST_F(RunInParts, FinishedPartsAreKeptOnResume) {
    const std::string reference = parts(1)[0].id;
    RunOptions o = options();
    o.resume = true;
    for (const std::string& id : {reference, std::string("variant.value-1")}) {
        runPart(id);
        const int before = Truth::runs + Constant::runs;
        o.part = id;
        EXPECT_EQ(run(kSweep, o).exitStatus(), 0);
        EXPECT_EQ(Truth::runs + Constant::runs, before) << id;
    }
    const int before = Constant::runs;
    runPart("variant.value-1");
    EXPECT_GT(Constant::runs, before);
}

TEST_F(RunInParts, UnknownPartsAndOtherExperimentsAreRefused) {
    EXPECT_CONTAINS(errorOf<UsageError>([&] { runPart("variant.value-2"); }), "'variant.value-1'");
    EXPECT_FALSE(fs::exists(root_ / "out"));
    runPart(parts(1)[0].id);
    const std::string other = std::string(kSweep) + "seed: 3\n";
    EXPECT_CONTAINS(errorOf<UsageError>([&] { runPart(parts(1, other)[0].id, "out", other); }),
                    "holds parts of another experiment: config.seed: nothing and 3");
}

TEST_F(RunInParts, AReferenceInTheCacheIsNotRenderedInPartsAgain) {
    const std::vector<Part> all = parts(3);
    runPart(all[1].id);
    EXPECT_EQ(Truth::runs, 1);
    RunOptions o = options();
    o.out = root_ / "whole";
    run(kSweep, o);
    const int rendered = Truth::runs;
    runPart(all[0].id);
    runPart(all[2].id);
    EXPECT_EQ(Truth::runs, rendered);

    // Parts that hold all samples and one that holds its own are still the same reference
    useCache("other-cache");
    EXPECT_EQ(runPart("variant.value-0.5").exitStatus(), 0);
    EXPECT_EQ(Truth::runs, rendered);
    runPart("variant.value-1");
    EXPECT_EQ(runPart("merge").exitStatus(), 0);
    EXPECT_EQ(cell("value-0.5", "nrmse"), "0.5");
    EXPECT_EQ(cell("value-1", "nrmse"), "0");
}

TEST_F(RunInParts, WhatPartsWarnOfReachesTheMerge) {
    RunOptions o = options();
    o.part = parts(1)[0].id;
    run(kSweep, o);
    o.part = "variant.value-1";
    o.untimed = true;
    run(kSweep, o);
    o.untimed = false;
    o.part = "variant.value-0.5";
    run(kSweep, o);
    const auto manifest = [&](const std::string& folder) {
        return nlohmann::json::parse(readTextFile(root_ / folder / "manifest.json"));
    };
    const size_t before = manifest("out")["warnings"].size();
    EXPECT_EQ(merge({"out"}, "all").exitStatus(), 0);
    const auto warnings = manifest("all")["warnings"];
    ASSERT_EQ(warnings.size(), before + 1);
    EXPECT_CONTAINS(warnings.back().get<std::string>(), "their times tell nothing");
}

TEST_F(RunInParts, AFailedReferenceIsWhyVariantsFailed) {
    std::string text = config(kSweep);
    const std::string pass = "pass: truth";
    text.replace(text.find(pass), pass.size(), pass + ", fail: true");
    const Registry passes = registry();
    const auto wired = [&] { return makeStudy(parseExperiment(text, "fake.yaml"), passes); };
    RunOptions o = options();
    PreparedExperiment prepared(wired(), o);
    const std::string id = partsOf(prepared, 1)[0].id;
    o.part = id;
    EXPECT_ERROR("no truth", runExperiment(wired(), o));
    o.part = "merge";
    EXPECT_EQ(runExperiment(wired(), o).failed, 2u);
    EXPECT_EQ(cell("value-1", "status"), "failed");
    EXPECT_CONTAINS(cell("value-0.5", "error"), id + ": ");
}

TEST_F(RunInParts, AFailedVariantIsAnErrorAndARowOfTheMerge) {
    const std::string sweep = "sweep: {constant.fail: [true, false]}\n";
    runPart(parts(1, sweep)[0].id, "out", sweep);
    EXPECT_ERROR("the pass gave up", runPart("variant.fail-true", "out", sweep));
    EXPECT_FALSE(fs::exists(root_ / "out" / "images" / "fail-true"));
    runPart("variant.fail-false", "out", sweep);
    const RunSummary summary = merge({"out"}, "all");
    EXPECT_EQ(summary.failed, 1u);
    EXPECT_EQ(summary.missing, 0u);
    EXPECT_EQ(summary.exitStatus(), 1);
    fs::remove_all(root_ / "out");
    fs::rename(root_ / "all", root_ / "out");
    EXPECT_EQ(cell("fail-false", "status"), "ok");
    EXPECT_EQ(cell("fail-true", "status"), "failed");
    EXPECT_EQ(cell("fail-true", "constant.fail"), "true");
    EXPECT_EQ(cell("fail-true", "error"), "the pass gave up");

    // Merged once more it is still known why; once it is done, it is a result
    EXPECT_EQ(runPart("merge", "out", sweep).failed, 1u);
    fs::remove_all(root_ / "out" / "parts");
    EXPECT_EQ(runPart("merge", "out", sweep).missing, 1u);
    EXPECT_EQ(cell("fail-true", "status"), "absent");
}

TEST_F(RunInParts, AFailedVariantKeepsItsValuesWhereAnAxisIsIdle) {
    // No image of 'plain' depends on 'under', whose values make no more variants of it
    const std::string sweep =
        "sweep:\n"
        "  constant:\n"
        "    plain: [{pass: constant, id: under}, {pass: constant, fail: true}]\n"
        "    veiled: [{pass: constant, id: under}, veil]\n"
        "  under.value: [0.25, 0.5]\n";
    runPart(parts(1, sweep)[0].id, "out", sweep);
    EXPECT_ERROR("the pass gave up", runPart("variant.plain", "out", sweep));
    EXPECT_EQ(runPart("merge", "out", sweep).failed, 1u);
    EXPECT_EQ(cell("plain", "name"), "plain");
    EXPECT_EQ(cell("plain", "constant"), "plain");
    EXPECT_EQ(cell("plain", "under.value"), "-");
}

TEST_F(RunInParts, FoldersOfSeveralMachinesAreMerged) {
    const std::string sweep = "sweep: {image.width: [8, 16]}\n";
    run(sweep);
    const std::string right = readTextFile(root_ / "out" / "passes.csv");
    for (const char* width : {"16", "8"}) {
        const std::string folder = std::string("machine-") + width;
        runPart(std::string("variant.width-") + width, folder, sweep);
    }
    EXPECT_EQ(merge({"machine-8", "machine-16"}, "all").exitStatus(), 0);
    fs::remove_all(root_ / "out");
    fs::rename(root_ / "all", root_ / "out");
    EXPECT_EQ(cell("width-8", "status"), "ok");
    EXPECT_EQ(cell("width-16", "nrmse"), "0");
    const auto manifest = nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json"));
    ASSERT_EQ(manifest["references"].size(), 2u);
    for (const auto& reference : manifest["references"]) {
        const std::string folder = reference["folder"].get<std::string>();
        EXPECT_TRUE(fs::exists(root_ / "out" / "images" / folder / "final.exr")) << folder;
        EXPECT_EQ(reference["variants"].size(), 1u);
    }
    EXPECT_EQ(std::ranges::count(readTextFile(root_ / "out" / "passes.csv"), '\n'), std::ranges::count(right, '\n'));
}

TEST_F(RunInParts, WhatDiffersIsNotMerged) {
    run(kSweep);
    fs::copy(root_ / "out", root_ / "copy", fs::copy_options::recursive);
    const auto refusal = [&](const std::string& out = "all") {
        const std::string message = errorOf<UsageError>([&] { merge({"out", "copy"}, out); });
        EXPECT_FALSE(fs::exists(root_ / "all"));
        return message;
    };
    EXPECT_CONTAINS(refusal(), "'value-1'");

    // Each of the manifest's keys that tell an experiment apart
    const std::string text = readTextFile(root_ / "copy" / "manifest.json");
    const auto refusalOf = [&](const std::string& key, const std::string& value, auto&& change) {
        auto manifest = nlohmann::ordered_json::parse(text);
        change(manifest);
        writeFileAtomically(root_ / "copy" / "manifest.json", manifest.dump());
        EXPECT_CONTAINS(refusal(), key);
        EXPECT_CONTAINS(refusal(), value);
    };
    refusalOf("config.measure.frames: 3 and 4", "copy", [](auto& m) { m["config"]["measure"]["frames"] = 4; });
    refusalOf("voxray_version: ", "\"0.0\"", [](auto& m) { m["voxray_version"] = "0.0"; });
    refusalOf("commit: ", "\"abc\"", [](auto& m) { m["commit"] = "abc"; });
    refusalOf("inputs.value-1.scene: ", "\"abc\"", [](auto& m) { m["inputs"]["value-1"]["scene"] = "abc"; });
    refusalOf("older version", "copy", [](auto& m) { m.erase("inputs"); });

    // Other results in the target, and no results
    EXPECT_CONTAINS(errorOf<UsageError>([&] { merge({"out"}, "copy"); }), "holds results already");
    EXPECT_CONTAINS(errorOf<UsageError>([&] { merge({"out", "nowhere"}, "all"); }), "holds no results of Voxray");
}

TEST_F(RunInParts, SumsAreKeptToTheBitAndDamageIsNoticed) {
    RenderedPart part;
    for (auto* light : {&part.sums.final, &part.sums.indirect})
        for (uint64_t half : {0, 1}) {
            (*light)[half] = SampleSums(3, 2, 5 + half);
            for (double& value : (*light)[half].data) value = 1.0 / double(3 + half);
        }
    part.seconds = 2;
    const std::string hash = "0123456789abcdef0123456789abcdef";
    const ReferenceParts folder(root_);
    folder.store(hash, {0, 2}, part);
    EXPECT_FALSE(folder.isWhole(hash));
    folder.store(hash, {1, 2}, part);
    ASSERT_TRUE(folder.isWhole(hash));
    const RenderedPart sum = folder.load(hash, 3, 2);
    EXPECT_EQ(sum.sums.final[1].data[0], 2.0 / 4.0);
    EXPECT_EQ(sum.sums.indirect[0].samples, 10u);
    EXPECT_EQ(sum.seconds, 4);

    // A reference as a part of its own is the same reference
    const ReferenceImages images = imagesOf(sum), again = imagesOf(partOf(images));
    EXPECT_EQ(images.final.a.data, again.final.a.data);
    EXPECT_EQ(images.indirect.mean.data, again.indirect.mean.data);
    EXPECT_ERROR("another reference", folder.load(hash, 2, 2));

    const fs::path file = root_ / "parts" / (ReferenceParts::id(hash, {1, 2}) + ".sums");
    const std::string whole = readTextFile(file);
    for (const std::string& damaged :
         {whole.substr(0, whole.size() - 8), std::string(), whole.substr(0, 100) + "!" + whole.substr(101)}) {
        writeFileAtomically(file, damaged);
        EXPECT_CONTAINS(errorOf([&] { folder.load(hash, 3, 2); }), file.string() + ": ");
    }
}
