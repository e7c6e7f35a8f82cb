#include <nlohmann/json.hpp>

#include "experiment_fakes.h"
#include "image/image.h"
#include "image/score.h"
#include "tests/support/errors.h"

using namespace voxray;
using namespace voxray::fakes;
namespace fs = std::filesystem;

TEST_F(RunTest, WritesResultsWithTheScoresOfClosedForms) {
    const RunSummary summary = run("sweep: {constant.value: [1, 0.5]}\n");
    EXPECT_EQ(summary.ok, 2u);
    EXPECT_EQ(summary.exitStatus(), 0);

    // |v - 1| and (v - 1)² / 1.01, and the same for the halves against 0.5
    EXPECT_EQ(cell("value-1", "nrmse"), "0");
    EXPECT_EQ(cell("value-1", "psnr_db"), "100");
    EXPECT_NEAR(std::stod(cell("value-0.5", "nrmse")), 0.5, 1e-6);
    EXPECT_NEAR(std::stod(cell("value-0.5", "relmse")), 0.25 / 1.01, 1e-6);
    EXPECT_NEAR(std::stod(cell("value-0.5", "indirect_nrmse")), 0.5, 1e-6);
    EXPECT_NEAR(std::stod(cell("value-0.5", "mean_ratio")), 0.5, 1e-6);
    EXPECT_EQ(cell("value-0.5", "constant.value"), "0.5");
    EXPECT_EQ(cell("value-0.5", "rays"), "10");
    EXPECT_EQ(cell("value-0.5", "status"), "ok");

    // Files
    const fs::path out = root_ / "out";
    for (const char* name :
         {"final.exr", "indirect.exr", "final.png", "indirect.png", "flip.png", "indirect_flip.png", "result.json"})
        EXPECT_TRUE(fs::exists(out / "images" / "value-0.5" / name)) << name;
    for (const char* name : {"final.exr", "indirect.exr", "final.png", "indirect.png", "final_a.exr", "indirect_b.exr"})
        EXPECT_TRUE(fs::exists(out / "images" / "reference" / name)) << name;
    EXPECT_EQ(readImage(out / "images" / "value-0.5" / "final.exr").data[0], 0.5f);
    EXPECT_CONTAINS(readTextFile(out / "passes.csv"), "value-0.5,constant,frame,");

    // Halves without noise: it is no floor, and intervals are points
    const auto manifest = nlohmann::json::parse(readTextFile(out / "manifest.json"));
    EXPECT_EQ(manifest["reference"]["flip_noise"], 0);
    EXPECT_EQ(manifest["reference"]["indirect_psnr_db_noise"], 100);
    EXPECT_FALSE(manifest["reference"].contains("nrmse_noise"));
    EXPECT_NEAR(std::stod(cell("value-0.5", "nrmse_low")), 0.5, 1e-6);
    EXPECT_NEAR(std::stod(cell("value-0.5", "indirect_relmse_high")), 0.25 / 1.01, 1e-6);
    EXPECT_EQ(manifest["reference"]["spp"], 4);
    EXPECT_NEAR(manifest["baselines"]["black"]["nrmse"].get<double>(), 1, 1e-6);
    EXPECT_NEAR(manifest["baselines"]["constant"]["nrmse"].get<double>(), 0, 1e-6);
    EXPECT_EQ(manifest["config"]["name"], "fake");
    EXPECT_EQ(manifest["metrics"].size(), metrics().size());
    EXPECT_EQ(manifest["metrics"][0]["name"], "nrmse");
    EXPECT_EQ(manifest["metrics"][0]["better"], "low");
    EXPECT_EQ(manifest["metrics"][0]["interval"], true);
    EXPECT_EQ(manifest["metrics"][2]["interval"], false);
    EXPECT_EQ(manifest["sweep_keys"][0], "constant.value");
    EXPECT_TRUE(manifest["finished"].is_string());
}

TEST_F(RunTest, ColumnsAreTheDocumentedOnes) {
    run("sweep: {constant.value: [1]}\n");
    // Every metric, the ends of its interval right after it; the total light's, then the indirect light's.
    std::string expected =
        "variant,name,status,error,device,tracer,constant.value,build_ms,frame_ms_median,frame_ms_p05,"
        "frame_ms_p95,memory_bytes,peak_bytes,rays,tracer_build_ms,tracer_bytes";
    for (const std::string light : {",", ",indirect_"})
        for (const Metric& metric : metrics()) {
            expected += light + metric.name;
            if (metric.hasInterval) expected += light + metric.name + "_low" + light + metric.name + "_high";
        }
    const std::string text = readTextFile(root_ / "out" / "results.csv");
    EXPECT_EQ(text.substr(0, text.find('\n')), expected);
    EXPECT_CONTAINS(expected, ",tracer_bytes,nrmse,nrmse_low,nrmse_high,");
    EXPECT_CONTAINS(expected, ",indirect_mean_ratio");
}

TEST_F(RunTest, NoiseOfTheReferenceIsTakenOffOrIsAFloor) {
    const Experiment noisy =
        parseExperiment(config("sweep: {constant.value: [1, 0.5]}\n"), "fake.yaml", {"", {"reference.noise=0.25"}});
    EXPECT_EQ(runExperiment(noisy, options(), registry()).exitStatus(), 0);

    // (0.5 - 0.75) (0.5 - 1.25); for a perfect image the product is negative and counts as 0
    EXPECT_NEAR(std::stod(cell("value-0.5", "nrmse")), std::sqrt(0.25 * 0.75), 1e-6);
    EXPECT_NEAR(std::stod(cell("value-0.5", "indirect_nrmse")), std::sqrt(0.25 * 0.75), 1e-6);
    for (const char* column : {"nrmse", "nrmse_low", "nrmse_high", "relmse"})
        EXPECT_EQ(cell("value-1", column), "0") << column;

    // Those that noise isn't taken off have a floor
    const auto reference = nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json"))["reference"];
    EXPECT_GT(reference["flip_noise"].get<double>(), 0.01);
    EXPECT_LT(reference["ssim_noise"].get<double>(), 0.999);
    EXPECT_FALSE(reference.contains("mean_ratio_noise"));
}

TEST_F(RunTest, NanFailsItsVariantAndNamesThePass) {
    const RunSummary summary = run("sweep: {constant.nan: [true, false]}\n");
    EXPECT_EQ(summary.ok, 1u);
    EXPECT_EQ(summary.failed, 1u);
    EXPECT_EQ(summary.exitStatus(), 1);
    EXPECT_EQ(cell("nan-true", "status"), "failed");
    EXPECT_CONTAINS(readTextFile(root_ / "out" / "results.csv"), "'constant'");
    EXPECT_EQ(cell("nan-false", "status"), "ok");
    EXPECT_FALSE(fs::exists(root_ / "out" / "images" / "nan-true"));
}

TEST_F(RunTest, ThrowingPassFailsItsVariantAlone) {
    EXPECT_EQ(run("sweep: {constant.fail: [true, false]}\n").failed, 1u);
    EXPECT_EQ(cell("fail-true", "error"), "the pass gave up");
    EXPECT_EQ(cell("fail-true", "nrmse"), "");
    EXPECT_EQ(cell("fail-false", "status"), "ok");
}

TEST_F(RunTest, MessagesOfTheValidationLayerFailTheRunAndArePrinted) {
    testing::internal::CaptureStderr();
    const RunSummary summary = run("sweep: {constant.misuse: [true, false]}\n");
    const std::string errors = testing::internal::GetCapturedStderr();
    EXPECT_EQ(summary.failed, 1u);
    EXPECT_GE(summary.validationMessages, 1u);
    EXPECT_EQ(summary.exitStatus(), 1);
    EXPECT_CONTAINS(errors, "Vulkan validation: ");
    EXPECT_CONTAINS(cell("misuse-true", "error"), "Vulkan validation");
    EXPECT_EQ(cell("misuse-false", "status"), "ok");
}

TEST_F(RunTest, MemoryAboveTheConfigsLimitIsRefused) {
    const RunSummary summary = run("sweep: {constant.megabytes: [0, 64]}\n", [&] {
        RunOptions o = options();
        return o;
    }());
    EXPECT_EQ(summary.failed, 0u);
    fs::remove_all(root_ / "out");
    const Experiment limited = parseExperiment(config("sweep: {constant.megabytes: [0, 64]}\n"), "fake.yaml",
                                               {"", {"measure.memory_limit_mb=32"}});
    EXPECT_EQ(runExperiment(limited, options(), registry()).failed, 1u);
    EXPECT_CONTAINS(readTextFile(root_ / "out" / "results.csv"), "the limit is 32.0 MiB");
}

TEST_F(RunTest, WithoutReferenceThereAreNoScores) {
    const Experiment e = parseExperiment(config(""), "fake.yaml", {"", {"reference=null"}});
    EXPECT_EQ(runExperiment(e, options(), registry()).exitStatus(), 0);
    EXPECT_EQ(cell("default", "status"), "ok");
    EXPECT_EQ(cell("default", "nrmse"), "");
    EXPECT_EQ(Truth::runs, 0);
}

TEST_F(RunTest, ReferenceIsCachedByWhatItDependsOn) {
    run("");
    EXPECT_EQ(Truth::runs, 1);
    const std::string scores = cell("default", "relmse");
    const std::vector<float> pixels = readImage(root_ / "out" / "images" / "default" / "final.exr").data;
    run("");
    EXPECT_EQ(Truth::runs, 1);
    EXPECT_EQ(cell("default", "relmse"), scores);
    EXPECT_EQ(readImage(root_ / "out" / "images" / "default" / "final.exr").data, pixels);

    // Another seed, size, camera or sample count is another reference
    int runs = 1;
    for (const char* change : {"seed=3", "image.width=9", "scene.camera={position: [0, 1, 3], target: [0, 1, 0]}",
                               "reference.spp=5", "scene.materials=lambert", "scene.environment=0.5"}) {
        runExperiment(parseExperiment(config(""), "fake.yaml", {"", {change}}), options(), registry());
        EXPECT_EQ(Truth::runs, ++runs) << change;
    }

    // What the graph does is not part of it, and a damaged cache is rendered again
    runExperiment(parseExperiment(config(""), "fake.yaml", {"", {"constant.value=2"}}), options(), registry());
    EXPECT_EQ(Truth::runs, runs);
    for (const auto& entry : fs::recursive_directory_iterator(root_ / "cache" / "references"))
        if (entry.path().filename() == "final_a.exr") std::ofstream(entry.path()) << "broken";
    run("");
    EXPECT_EQ(Truth::runs, runs + 1);
}

TEST_F(RunTest, TheCameraMovesFromFrameToFrame) {
    // One warm-up frame leads up to the first measured one, where the camera is where the config says.
    const auto runAndMove = [&](const std::string& move) {
        Constant::cameraX.clear();
        const std::string camera = "scene.camera={position: [2, 1, 3], target: [0, 1, 0]" + move + "}";
        runExperiment(parseExperiment(config(""), "fake.yaml", {"", {camera}}), options(), registry());
        return Constant::cameraX;
    };
    EXPECT_EQ(runAndMove(", move: [0.5, 0, 0]"), (std::vector<float>{1.5f, 2, 2.5f, 3}));
    // The reference stands still: it is the same.
    const int references = Truth::runs;
    EXPECT_EQ(runAndMove(""), (std::vector<float>{2, 2, 2, 2}));
    EXPECT_EQ(Truth::runs, references);
    // A path begins at the first measured frame
    EXPECT_EQ(runAndMove(", path: [{frame: 1, position: [4, 1, 3], target: [0, 1, 0]}, "
                         "{frame: 3, position: [8, 1, 3], target: [0, 1, 0]}]"),
              (std::vector<float>{2, 2, 4, 6}));
    EXPECT_EQ(Truth::runs, references);
}

TEST_F(RunTest, SurfacesAndLightsMoveFromFrameToFrame) {
    const auto runWith = [&](const std::string& scene) {
        Witness::sights.clear();
        const std::string text = "name: fake\nscene: {builtin: cornell, " + scene +
                                 "}\nimage: {width: 8, height: 4}\ngraph: [{pass: witness}, {pass: constant}]\n"
                                 "reference: {pass: truth}\nmeasure: {frames: 2, warmup: 1}\n";
        EXPECT_EQ(runExperiment(parseExperiment(text, "fake.yaml"), options(), registry()).exitStatus(), 0);
        return Witness::sights;
    };
    const std::string lights = "lights: [{point: [0, 1, 0], move: [0.5, 0, 0]}]";
    const std::string spheres = "moving_spheres: {count: 9, swing: [1, 0, 0], period: 4}";

    // Two builds in the compared frame, then a frame before it, the frame itself, and one after it.
    const auto moving = runWith(lights + ", time: 0.25, time_step: 0.5, " + spheres);
    ASSERT_EQ(moving.size(), 5u);
    const int changed[] = {-1, -1, 18, 18, 18};
    const float lightX[] = {0, 0, -0.5f, 0, 0.5f};
    // At 0.25 s it is 0.25 m on, at -0.25 s as far back.
    const float shift[] = {0, 0, -0.5f, 0, 0.5f};
    for (size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(moving[i].changed, changed[i]) << i;
        EXPECT_EQ(moving[i].light.x, lightX[i]) << i;
        EXPECT_NEAR(moving[i].corner.x - moving[0].corner.x, shift[i], 1e-6f) << i;
        EXPECT_EQ(moving[i].frameIndex, 0u);
    }
    EXPECT_EQ(Truth::runs, 1);

    // Build passes have a row for their build and one for their update, and the scene has one.
    std::vector<std::string> rows;
    std::istringstream lines(readTextFile(root_ / "out" / "passes.csv"));
    for (std::string line; std::getline(lines, line);) rows.push_back(split(line)[1] + " " + split(line)[2]);
    EXPECT_EQ(rows, (std::vector<std::string>{"pass phase", "scene frame", "witness build", "witness frame",
                                              "constant frame"}));

    // A light alone: no surface changes; it needs no new reference for where it goes.
    const auto lamp = runWith(lights);
    ASSERT_EQ(lamp.size(), 5u);
    EXPECT_EQ(lamp[3].changed, 0);
    EXPECT_EQ(lamp[4].light.x, 0.5f);
    EXPECT_EQ(Truth::runs, 2);
    EXPECT_EQ(runWith("lights: [{point: [0, 1, 0]}]").size(), 2u);
    EXPECT_EQ(Truth::runs, 2);
}

TEST_F(RunTest, VariantsOfOneSceneBeginInTheComparedFrame) {
    Witness::sights.clear();
    const std::string text =
        "name: fake\nscene: {builtin: spheres, time_step: 0.5}\nimage: {width: 8, height: 4}\n"
        "graph: [{pass: witness}, {pass: constant}]\nsweep: {constant.value: [1, 2]}\n"
        "measure: {frames: 2, warmup: 0}\n";
    EXPECT_EQ(runExperiment(parseExperiment(text, "fake.yaml"), options(), registry()).exitStatus(), 0);
    ASSERT_EQ(Witness::sights.size(), 8u);
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(Witness::sights[i].corner, Witness::sights[4 + i].corner) << i;
    EXPECT_NE(Witness::sights[3].corner, Witness::sights[0].corner);
}

TEST_F(RunTest, LightThatLosesItsDirectionIsNamed) {
    const RunSummary summary = runExperiment(
        parseExperiment(config(""), "fake.yaml", {"", {"scene.lights=[{directional: [0, -1, 0], move: [0, 1, 0]}]"}}),
        options(), registry());
    EXPECT_EQ(summary.exitStatus(), 1);
    EXPECT_CONTAINS(cell("default", "error"), "'move'");
}

TEST_F(RunTest, SeveralReferencesGetTheirOwnFolders) {
    EXPECT_EQ(run("sweep: {image.width: [8, 16]}\n").exitStatus(), 0);
    EXPECT_EQ(Truth::runs, 2);
    EXPECT_TRUE(fs::exists(root_ / "out" / "images" / "reference" / "final.exr"));
    EXPECT_EQ(readImage(root_ / "out" / "images" / "reference.2" / "final.exr").width, 16u);
    const auto manifest = nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json"));
    EXPECT_EQ(manifest["references"][0]["variants"], std::vector<std::string>{"width-8"});
    EXPECT_EQ(manifest["references"][1]["variants"], std::vector<std::string>{"width-16"});
}

TEST_F(RunTest, ResumeRepeatsNothingThatWasFinished) {
    run("sweep: {constant.value: [1, 0.5, 0.25]}\n");
    const int runsOfOne = Constant::runs / 3;
    const std::string before = readTextFile(root_ / "out" / "results.csv");
    RunOptions o = options();
    o.resume = true;
    EXPECT_EQ(run("sweep: {constant.value: [1, 0.5, 0.25]}\n", o).resumed, 3u);
    EXPECT_EQ(Constant::runs, 3 * runsOfOne);
    EXPECT_EQ(readTextFile(root_ / "out" / "results.csv"), before);
    const auto manifest = nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json"));
    EXPECT_NEAR(manifest["baselines"]["black"]["nrmse"].get<double>(), 1, 1e-6);

    // As a killed run leaves it: the last variant half-written, no tables
    fs::rename(root_ / "out" / "images" / "value-0.25", root_ / "out" / "images" / ".tmp-value-0.25");
    fs::remove(root_ / "out" / "results.csv");
    EXPECT_EQ(run("sweep: {constant.value: [1, 0.5, 0.25]}\n", o).resumed, 2u);
    EXPECT_EQ(Constant::runs, 4 * runsOfOne);
    EXPECT_EQ(cell("value-0.25", "nrmse"), "0.75");
    EXPECT_FALSE(fs::exists(root_ / "out" / "images" / ".tmp-value-0.25"));
}

TEST_F(RunTest, VariantsTellTheSessionThatMeasuredThem) {
    const auto manifest = [&] { return nlohmann::json::parse(readTextFile(root_ / "out" / "manifest.json")); };
    run("sweep: {constant.value: [1, 0.5]}\n");
    const auto first = manifest();
    ASSERT_EQ(first["sessions"].size(), 1u);
    EXPECT_EQ(first["sessions"][0]["started"], first["started"]);
    EXPECT_EQ(first["sessions"][0]["variants"], (std::vector<std::string>{"value-1", "value-0.5"}));

    // The second one is taken over from an earlier session
    const fs::path file = root_ / "out" / "images" / "value-0.5" / "result.json";
    auto result = nlohmann::ordered_json::parse(readTextFile(file));
    EXPECT_EQ(result["session"], first["started"]);
    result["session"] = "2020-02-20T20:20:20Z";
    writeFileAtomically(file, result.dump());
    fs::remove_all(root_ / "out" / "images" / "value-1");
    RunOptions o = options();
    o.resume = true;
    EXPECT_EQ(run("sweep: {constant.value: [1, 0.5]}\n", o).resumed, 1u);
    const auto second = manifest();
    ASSERT_EQ(second["sessions"].size(), 2u);
    EXPECT_EQ(second["sessions"][0]["started"], "2020-02-20T20:20:20Z");
    EXPECT_EQ(second["sessions"][0]["variants"], std::vector<std::string>{"value-0.5"});
    EXPECT_EQ(second["sessions"][1]["started"], second["started"]);
    EXPECT_EQ(second["sessions"][1]["variants"], std::vector<std::string>{"value-1"});
}

TEST_F(RunTest, ResumeRefusesAnotherExperimentAndNamesTheDifference) {
    run("");
    RunOptions o = options();
    o.resume = true;
    const auto errorWith = [&](const std::string& assignment) {
        return errorOf([&] {
            runExperiment(parseExperiment(config(""), "fake.yaml", {"", {assignment}}), o, registry());
        });
    };
    EXPECT_CONTAINS(errorWith("seed=2"), "another seed (0, now 2)");
    EXPECT_CONTAINS(errorWith("constant.value=2"), "another graph");
    EXPECT_CONTAINS(errorWith("image.width=9"), "another image");
    EXPECT_CONTAINS(errorWith("name=other"), "'fake'");
}

TEST_F(RunTest, InterruptKeepsWhatWasFinished) {
    const RunSummary summary = run("sweep: {constant.interrupt: [false, true]}\n");
    EXPECT_TRUE(summary.interrupted);
    EXPECT_EQ(summary.exitStatus(), 130);
    EXPECT_EQ(cell("interrupt-false", "status"), "ok");
    EXPECT_EQ(cell("interrupt-true", "status"), "absent");
    for (const auto& entry : fs::directory_iterator(root_ / "out" / "images"))
        EXPECT_EQ(entry.path().filename().string().rfind(".tmp", 0), std::string::npos) << entry.path();
}

TEST_F(RunTest, InterruptBeforeAnythingIsRenderedKeepsTheOldRun) {
    run("sweep: {constant.value: [1]}\n");
    const RunSummary summary = run("sweep: {constant.interrupt_plan: [true]}\n");
    EXPECT_EQ(summary.exitStatus(), 130);
    EXPECT_EQ(summary.ok, 0u);
    EXPECT_EQ(cell("value-1", "status"), "ok");
    EXPECT_TRUE(fs::exists(root_ / "out" / "images" / "value-1" / "final.exr"));
}

TEST_F(RunTest, ForeignAndUnwritableFoldersAreRefused) {
    fs::create_directories(root_ / "out");
    std::ofstream(root_ / "out" / "precious.txt") << "mine";
    EXPECT_THROW(run(""), Error);
    EXPECT_TRUE(fs::exists(root_ / "out" / "precious.txt"));
    EXPECT_FALSE(fs::exists(root_ / "out" / "images"));
    for (const char* place : {"/proc/voxray", "/dev/null/x"}) {
        RunOptions o = options();
        o.out = place;
        EXPECT_THROW(run("", o), Error) << place;
    }
    EXPECT_EQ(Constant::runs, 0);
}

TEST_F(RunTest, AFreshRunRemovesTheOldOnesImages) {
    run("sweep: {constant.value: [1, 0.5]}\n");
    run("sweep: {constant.value: [1]}\n");
    EXPECT_FALSE(fs::exists(root_ / "out" / "images" / "value-0.5"));
    EXPECT_TRUE(fs::exists(root_ / "out" / "images" / "value-1"));
}

TEST_F(RunTest, DryRunRendersNothing) {
    RunOptions o = options();
    o.dryRun = true;
    testing::internal::CaptureStdout();
    EXPECT_EQ(run("sweep: {constant.megabytes: [0, 64]}\n", o).exitStatus(), 0);
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_CONTAINS(text, "megabytes 64");
    EXPECT_CONTAINS(text, "64.0 MiB");
    EXPECT_EQ(Constant::runs, 0);
    EXPECT_FALSE(fs::exists(root_ / "out"));
}

TEST_F(RunTest, MissingSceneFileSaysWhereItLooked) {
    const Experiment e =
        parseExperiment("name: x\nscene: {file: absent.glb}\ngraph: [{pass: constant}]\n", (root_ / "x.yaml").string());
    RunOptions o = options();
    o.scenes = root_ / "scenes";
    EXPECT_CONTAINS(errorOf<UsageError>([&] { runExperiment(e, o, registry()); }),
                    "x.yaml:2: no file 'absent.glb' in " + (root_ / "scenes").string());
}

TEST_F(RunTest, CameraAndBuiltinErrorsNameTheNearestWord) {
    const auto errorWith = [&](const std::string& assignment) {
        return errorOf<UsageError>([&] {
            runExperiment(parseExperiment(config(""), "fake.yaml", {"", {assignment}}), options(), registry());
        });
    };
    EXPECT_CONTAINS(errorWith("scene.builtin=cornel"), "'cornell'");
    EXPECT_CONTAINS(errorWith("scene.camra=x"), "'camera'");
    EXPECT_CONTAINS(errorWith("scene.environment=absent.exr"), "'absent.exr'");
    EXPECT_FALSE(fs::exists(root_ / "out"));
}
