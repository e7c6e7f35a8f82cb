#include "experiment/prepared_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/progress.h"
#include "experiment/config_schema.h"
#include "experiment/results.h"
#include "experiment_fakes.h"
#include "image/score.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {

void expectError(const std::string& graph, std::initializer_list<const char*> parts) {
    const std::string text = "name: x\nscene: {builtin: cornell}\n" + graph;
    const std::string message =
        errorOf<UsageError>([&] { makeStudy(parseExperiment(text, "x.yaml"), fakes::registry()); });
    for (const char* part : parts) EXPECT_CONTAINS(message, part);
}

}  // namespace

TEST(Validate, AParameterOfAPassThatIsLeftOutMakesNoMoreVariants) {
    // Of two passes that write the image the last one counts, unless it reads the first one's
    const Registry registry = fakes::registry();
    const auto wired =
        makeStudy(parseExperiment("name: x\nscene: {builtin: cornell}\ngraph:\n  - {pass: constant, id: a}\n"
                                  "  - {pass: constant, id: b}\nsweep: {b: [constant, veil], a.value: [4, 5]}\n",
                                  "x.yaml"),
                  registry);
    std::vector<std::string> names;
    for (const Variant& variant : wired.variants) names.push_back(variant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"constant", "veil, value 4", "veil, value 5"}));
    EXPECT_EQ(wired.variants[0].values, (std::vector<std::string>{"constant", "-"}));

    // A whole pass neither, where nothing of what stands in its place runs
    const auto swapped =
        makeStudy(parseExperiment("name: x\nscene: {builtin: cornell}\ngraph:\n  - {pass: constant, id: a}\n"
                                  "  - {pass: constant, id: b}\nsweep:\n  a: {x: {pass: constant, value: 4}, y: "
                                  "[layers, constant]}\n"
                                  "  b: [constant, veil]\n",
                                  "x.yaml"),
                  registry);
    names.clear();
    for (const Variant& variant : swapped.variants) names.push_back(variant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"constant", "x, veil", "y, constant", "y, veil"}));

    // One that changes nothing anywhere is a mistake; an image that is written over is told first
    expectError("graph:\n  - {pass: constant, id: unseen}\n  - {pass: constant}\nsweep:\n  unseen.value: [1, 2]\n",
                {"x.yaml:4: ", "'unseen'"});
}

TEST(Validate, AValueWhosePassNeverRunsIsRefusedWhereAnothersRuns) {
    expectError(
        "graph:\n  - {pass: constant}\nsweep:\n"
        "  constant:\n    - constant\n    - [{pass: constant, id: other}, layers]\n",
        {"x.yaml:8: ", "'layers'"});
    // Values that have names
    expectError("graph:\n  - {pass: constant, id: c}\nsweep:\n  c: {whole: constant, part: [constant, layers]}\n",
                {"x.yaml:6: ", "'layers'"});
    // Different passes that are read
    makeStudy(parseExperiment("name: x\nscene: {builtin: cornell}\ngraph:\n  - {pass: layers, id: l}\n"
                              "  - {pass: constant}\nsweep: {l: [layers, witness]}\n",
                              "x.yaml"),
              fakes::registry());
}

TEST(Validate, GraphErrorsNameFileLineAndNearestWord) {
    expectError("graph:\n  - {pass: constnat}\n", {"x.yaml:4: ", "'constant'"});
    expectError("graph:\n  - {pass: constant, valeu: 3}\n", {"x.yaml:4: ", "'value'"});
    expectError("graph:\n  - {pass: constant, value: 1000}\n", {"x.yaml:4: ", "out of range"});
    expectError("graph:\n  - {pass: constant, value: high}\n", {"x.yaml:4: ", "expected a number"});
    expectError("graph:\n  - {pass: constant}\n  - {pass: relay}\n", {"x.yaml:5: ", "'extra'"});
    expectError("graph:\n  - {pass: constant}\n  - {pass: constant}\n", {"x.yaml:5: ", "two passes have the id"});
    expectError(
        "graph:\n  - {pass: constant}\n  - {pass: relay, id: a, inputs: {extra: b}}\n"
        "  - {pass: relay, id: b, inputs: {extra: a}}\n",
        {"x.yaml:5: ", "cycle between a, b"});
    expectError("graph:\n  - {pass: constant}\nsweep:\n  constant.valu: [1]\n", {"x.yaml:6: ", "'value'"});
    expectError("graph:\n  - {pass: constant}\nsweep:\n  constant: [constant, constnat]\n",
                {"x.yaml:6: ", "'constant'"});
    expectError("graph:\n  - {pass: constant, value: high}\nsweep:\n  constant.value: [1]\n",
                {"x.yaml:4: ", "expected a number"});
    expectError("graph:\n  - {pass: constant, id: c, value: 1000}\nsweep:\n  c: [{pass: constant}]\n",
                {"x.yaml:4: ", "out of range"});
    expectError("graph:\n  - {pass: constant, id: c}\nsweep:\n  c: [[witness, {pass: constnat}]]\n",
                {"x.yaml:6: ", "'constant'"});
    expectError(
        "graph:\n  - {pass: constant, id: c}\nsweep:\n"
        "  c:\n    - constant\n    - [witness, witness, constant]\n",
        {"x.yaml:8: ", "'witness'"});
    expectError("graph:\n  - {pass: constnat}\nsweep:\n  constant.value: [1]\n", {"x.yaml:4: ", "'constant'"});
    expectError("graph:\n  - {pass: constant, id: c}\nsweep:\n  c: [constant, {pass: constnat}]\n  c.value: [1]\n",
                {"x.yaml:6: ", "'constant'"});
    // Inputs of a pass that no variant runs as it is written
    const auto expectInputError = [](const std::string& input, std::initializer_list<const char*> parts) {
        expectError("graph:\n  - {pass: witness}\n  - {pass: constant, id: c, inputs: {" + input +
                        "}}\nsweep: {c: [constant]}\n",
                    parts);
    };
    expectInputError("testimony: witnes", {"x.yaml:5: ", "'witness'"});
    expectInputError("testimony: witness.truth", {"x.yaml:5: ", "'witness'"});
    expectInputError("testimoni: witness", {"x.yaml:5: ", "'testimony'"});
    expectError("graph:\n  - {pass: constant}\nreference: {pass: truth, ssp: 3}\n", {"x.yaml:5: ", "'spp'"});
    expectError("graph:\n  - {pass: constant}\nreference: {pass: constant}\n", {"x.yaml:5: ", "'sums'"});
    expectError("graph:\n  - {pass: relay, inputs: {extra: relay}}\n", {"x.yaml:4: "});
}

TEST(Validate, MotionIsRefusedWhereItHasNoEffectInAnyVariant) {
    const auto refusal = [](const std::string& scene, const std::string& rest) {
        const std::string text = "name: x\nscene: {" + scene + "}\n" + rest + "\ngraph: [{pass: constant}]\n";
        try {
            const Registry registry = fakes::registry();
            Study study = makeStudy(parseExperiment(text, "x.yaml"), registry);
            SceneLoader loader({});
            CameraViewChecks views({});
            planVariants(study, loader, views, DeviceInfo());
        } catch (const UsageError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string still = refusal("builtin: cornell, time_step: 0.1", "");
    EXPECT_CONTAINS(still, "x.yaml:2: scene.time_step: ");
    EXPECT_CONTAINS(refusal("builtin: cornell, time: 1", ""), "x.yaml:2: scene.time: ");
    EXPECT_EQ(refusal("builtin: spheres, time: 1, time_step: 0.1", ""), "");
    EXPECT_EQ(refusal("builtin: cornell, time_step: 0.1, moving_spheres: {count: 1}", ""), "");
    EXPECT_EQ(refusal("builtin: cornell, time_step: 0.1", "sweep: {scene.builtin: [cornell, spheres]}"), "");

    // A single frame
    const std::string single = "measure: {frames: 1, warmup: 0}";
    const std::string camera = "builtin: cornell, camera: {position: [0, 1, 3], target: [0, 1, 0], move: [0, 0, 1]}";
    EXPECT_CONTAINS(refusal("builtin: spheres, time_step: 0.1", single),
                    "scene.time_step: no effect: there is one frame");
    EXPECT_CONTAINS(refusal(camera, single), "x.yaml:2: scene.camera.move: ");
    EXPECT_CONTAINS(refusal("builtin: cornell, lights: [{point: [0, 1, 0], move: [0, 0.1, 0]}]", single),
                    "scene.lights: no effect");
    EXPECT_EQ(refusal(camera, "measure: {frames: 1, warmup: 1}"), "");
    const std::string path =
        "builtin: cornell, camera: {position: [0, 1, 3], target: [0, 1, 0], "
        "path: [{frame: 1, position: [0, 1, 2], target: [0, 1, 0]}]}";
    EXPECT_CONTAINS(refusal(path, "measure: {frames: 1, warmup: 1}"),
                    "x.yaml:2: scene.camera.path: no effect: there is one measured frame");
    EXPECT_EQ(refusal(path, "measure: {frames: 2}"), "");
}

TEST(Schema, ConfigSchemaHoldsEveryPassAndKey) {
    const auto json = nlohmann::json::parse(configJsonSchema(fakes::registry()).json());
    EXPECT_EQ(json["$schema"], "https://json-schema.org/draft/2020-12/schema");
    for (const char* key :
         {"name", "scene", "image", "seed", "tracer", "graph", "reference", "sweep", "measure", "profiles"})
        EXPECT_TRUE(json["properties"].contains(key)) << key;
    const auto& passes = json["properties"]["graph"]["items"]["oneOf"];
    ASSERT_EQ(passes.size(), 6u);
    EXPECT_EQ(passes[0]["properties"]["value"]["maximum"], 100);
    EXPECT_EQ(passes[0]["properties"]["value"]["default"], 1);
    EXPECT_EQ(passes[0]["additionalProperties"], false);
    EXPECT_EQ(json["properties"]["image"]["properties"]["width"]["type"], "integer");
    EXPECT_EQ(json["properties"]["tracer"]["enum"].size(), 4u);
    const auto& scene = json["properties"]["scene"]["properties"];
    EXPECT_EQ(scene["moving_spheres"]["properties"]["count"]["maximum"], 4096);
    EXPECT_TRUE(scene.contains("time_step"));
    const auto& added = scene["add"]["items"]["properties"];
    for (const char* key : {"file", "builtin", "count", "transform", "material"})
        EXPECT_TRUE(added.contains(key)) << key;
    EXPECT_EQ(added["material"]["properties"]["roughness"]["default"], 1);
    EXPECT_FALSE(scene["override"]["additionalProperties"]["properties"]["roughness"].contains("default"));
}

TEST(Results, CsvQuotesByRfc4180) {
    EXPECT_EQ(csvField("plain"), "plain");
    EXPECT_EQ(csvField("a,b"), "\"a,b\"");
    EXPECT_EQ(csvField("say \"hi\""), "\"say \"\"hi\"\"\"");
    EXPECT_EQ(csvField("two\nlines"), "\"two\nlines\"");
    EXPECT_EQ(csvField(""), "");

    VariantResult failed;
    failed.variant = "v";
    failed.name = "v, w";
    failed.error = "x, \"y\"";
    failed.sweepValues = {"[1, 2]"};
    const std::string text = resultsCsv({failed}, {"a.b"}, {});
    EXPECT_CONTAINS(text, "v,\"v, w\",failed,\"x, \"\"y\"\"\",,,\"[1, 2]\",,,,,,,");
}

TEST(Results, NumbersKeepNineDigits) {
    EXPECT_EQ(numberText(1.0 / 3), "0.333333333");
    EXPECT_EQ(numberText(0), "0");
    EXPECT_EQ(numberText(HUGE_VAL), "inf");
    EXPECT_EQ(numberText(1234567.25), "1234567.25");
}

TEST(Results, MetricsThatWereNotAskedForStayEmpty) {
    VariantResult r;
    r.variant = "v";
    r.ok = true;
    r.scores = {{"flip", 0.25}, {"nrmse", 0.5}, {"indirect_nrmse", 0.75}};
    MeasureSettings measure;
    measure.metrics = {"nrmse"};
    // Columns of scores: an empty one for each metric but one, and for the ends of intervals.
    std::string expected = "v,,ok,,,,0,0,0,0,0,0,0,0,0";
    for (const std::string score : {"0.5", "0.75"})
        for (const Metric& metric : metrics()) {
            expected += "," + (std::string(metric.name) == "nrmse" ? score : "");
            if (metric.hasInterval) expected += ",,";
        }
    EXPECT_CONTAINS(resultsCsv({r}, {}, measure), "\n" + expected + "\n");
}

TEST(Results, JsonSurvivesTheRoundTrip) {
    VariantResult r;
    r.ok = true;
    r.variant = "odd \"name\" \xc3\xa9\n";
    r.name = "odd, 1";
    r.sweepValues = {"1", "[2, 3]"};
    r.session = "2026-01-01T10:00:00Z";
    r.buildMs = 1.0 / 3;
    r.frameMs = {0.1, 0.2, 0.3};
    r.memoryBytes = uint64_t(1) << 40;
    r.peakBytes = uint64_t(1) << 41;
    r.rays = 77;
    r.tracerBuildMs = 0.7;
    r.tracerBytes = uint64_t(1) << 33;
    r.scores = {{"psnr_db", HUGE_VAL}, {"nrmse", 0.1}};
    r.passes.push_back({"p", Phase::Build, {1, 2, 3}, 4, 5, 6, 7, {8, 9, 10}});
    r.values = {{"p", "voxels, missed", std::nullopt, 7}, {"p", "change", 3, 0.1}};
    const VariantInputs inputs{{"seed", "3"}, {"graph", "{a: \"b\"}"}};
    const auto [back, backInputs] = parseResultJson(resultJson(r, inputs));
    EXPECT_EQ(back.variant, r.variant);
    EXPECT_EQ(back.name, r.name);
    EXPECT_EQ(back.sweepValues, r.sweepValues);
    EXPECT_EQ(back.session, r.session);
    EXPECT_EQ(back.buildMs, r.buildMs);
    EXPECT_EQ(back.frameMs.p95, 0.3);
    EXPECT_EQ(back.memoryBytes, r.memoryBytes);
    EXPECT_EQ(back.peakBytes, r.peakBytes);
    EXPECT_EQ(back.tracerBuildMs, 0.7);
    EXPECT_EQ(back.tracerBytes, r.tracerBytes);
    EXPECT_EQ(back.passes.at(0).scratchBytes, 7u);
    EXPECT_EQ(passesCsv({back}), passesCsv({r}));
    EXPECT_CONTAINS(passesCsv({back}), ",4,5,6,7,8,9,10,\n");
    EXPECT_EQ(back.scores, r.scores);
    EXPECT_EQ(back.passes.at(0).voxelSteps, 5u);
    EXPECT_EQ(valuesCsv({back}), valuesCsv({r}));
    EXPECT_CONTAINS(valuesCsv({back}), ",p,\"voxels, missed\",,7\n");
    EXPECT_CONTAINS(valuesCsv({back}), ",p,change,3,0.1\n");
    EXPECT_EQ(backInputs, inputs);
    EXPECT_THROW(parseResultJson("{\"variant\": 3}"), Error);
    EXPECT_THROW(parseResultJson(""), Error);
}

TEST(Measure, PercentilesInterpolate) {
    const Percentiles p = percentiles({5, 1, 3, 2, 4});
    EXPECT_DOUBLE_EQ(p.median, 3);
    EXPECT_DOUBLE_EQ(p.p05, 1.2);
    EXPECT_DOUBLE_EQ(p.p95, 4.8);
    EXPECT_DOUBLE_EQ(percentiles({7}).p95, 7);
    EXPECT_DOUBLE_EQ(percentiles({}).median, 0);
    EXPECT_DOUBLE_EQ(percentiles({1, 2}).median, 1.5);
}

TEST(Progress, Durations) {
    EXPECT_EQ(durationText(48.4), "48 s");
    EXPECT_EQ(durationText(200), "3 min 20 s");
    EXPECT_EQ(durationText(3900), "1 h 5 min");
}
