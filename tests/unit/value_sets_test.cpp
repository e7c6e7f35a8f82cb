// Parameters that have to be one of a few values: what they may be is known wherever a parameter is.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiment/config_schema.h"
#include "experiment/study.h"
#include "tests/support/all_passes.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {

struct ValueSetCase {
    std::string pass, parameter, bad;
    std::vector<std::string> allowed;
};

const std::vector<ValueSetCase> kCases{
    {"voxelize", "directions", "3", {"1", "6"}},
    {"voxelize_clipmap", "directions", "2", {"1", "6"}},
    {"voxelize_clipmap", "clipmap_resolution", "48", {"16", "32", "64", "128", "256", "512", "1024"}},
    {"filter_voxels", "clipmap_resolution", "8", {"16", "32", "64", "128", "256", "512", "1024"}},
    {"filter_voxels", "bounce_cones", "7", {"5", "6", "16", "36"}},
    {"light_clipmap", "bounce_cones", "0", {"5", "6", "16", "36"}},
    {"gather_cones", "cones", "7", {"5", "6", "16", "36"}},
    {"gather_cones", "specular", "3", {"0", "1", "7", "19"}},
    {"probe_irradiance", "cones", "4", {"5", "6", "16", "36"}},
    {"trace_gather_rays", "block", "3", {"1", "2", "4", "8"}},
};

std::string errorIn(const std::string& graph) {
    const std::string config = "name: x\nscene: {builtin: cornell}\ngraph:\n" + graph;
    return errorOf<UsageError>([&] { makeStudy(parseExperiment(config, "x.yaml"), test::allPasses()); });
}

}  // namespace

TEST(ValueSets, AreCheckedBeforeAnythingRuns) {
    for (const ValueSetCase& c : kCases) {
        const std::string pass = fmt::format("  - {{pass: {}, id: p", c.pass);
        EXPECT_CONTAINS(errorIn(fmt::format("{}, {}: {}}}\n", pass, c.parameter, c.bad)),
                        "x.yaml:4: p." + c.parameter + ": ");
        EXPECT_CONTAINS(errorIn(fmt::format("{}}}\nsweep:\n  p.{}: [{}]\n", pass, c.parameter, c.bad)),
                        "x.yaml:6: p." + c.parameter + ": ");
    }
}

TEST(ValueSets, StandInTheJsonSchema) {
    const auto json = nlohmann::json::parse(configJsonSchema(test::allPasses()).json());
    for (const ValueSetCase& c : kCases) {
        nlohmann::json parameter;
        for (const auto& pass : json["properties"]["graph"]["items"]["oneOf"])
            if (pass["properties"]["pass"]["const"] == c.pass) parameter = pass["properties"][c.parameter];
        ASSERT_FALSE(parameter.is_null()) << c.pass << "." << c.parameter;
        EXPECT_EQ(parameter["type"], "integer");
        EXPECT_EQ(parameter["enum"].dump(), fmt::format("[{}]", fmt::join(c.allowed, ",")));
    }
}
