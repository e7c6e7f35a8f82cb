// What is numbered by voxels is read together with these voxels alone.
#include <gtest/gtest.h>

#include "config/yaml.h"
#include "graph/graph.h"
#include "tests/support/errors.h"

namespace voxray {
namespace {

struct Voxels : Resource {};
struct Faces : Resource {
    std::string basisPort() const override { return "voxels"; }
};

// A pass that does nothing but have ports.
struct Idle : Pass {
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };
    static constexpr const char* kHelp = "Has ports.";
    void plan(PassPlan&) override {}
    void prepare(PassSetup&) override {}
    void record(PassContext&) override {}
};

struct MakeVoxels : Idle {
    static constexpr const char* kName = "make_voxels";
    explicit MakeVoxels(const Params&) {}
    void declare(PassBuilder& builder) override { builder.write<Voxels>("voxels", "the voxels"); }
};

struct LightFaces : Idle {
    static constexpr const char* kName = "light_faces";
    explicit LightFaces(const Params&) {}
    void declare(PassBuilder& builder) override {
        builder.read<Voxels>("voxels", "voxels to light");
        builder.write<Faces>("faces", "light of their faces");
    }
};

struct SmoothFaces : Idle {
    static constexpr const char* kName = "smooth_faces";
    explicit SmoothFaces(const Params&) {}
    void declare(PassBuilder& builder) override {
        builder.read<Faces>("faces", "light to smooth");
        builder.write<Faces>("faces", "smooth light");
    }
};

struct ShowFaces : Idle {
    static constexpr const char* kName = "show_faces";
    explicit ShowFaces(const Params&) {}
    void declare(PassBuilder& builder) override {
        builder.read<Voxels>("voxels", "where faces are");
        builder.read<Faces>("faces", "their light");
    }
};

void wire(const std::string& yaml) {
    Registry registry;
    registry.add<MakeVoxels>();
    registry.add<LightFaces>();
    registry.add<SmoothFaces>();
    registry.add<ShowFaces>();
    Graph(registry, parseYaml(yaml, "g.yaml"));
}

TEST(GraphBasis, LightIsReadWithItsOwnVoxels) {
    wire("- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: show_faces}\n");
    wire(
        "- {pass: make_voxels}\n- {pass: make_voxels, id: finer}\n- {pass: light_faces}\n- {pass: "
        "show_faces}\n");
    wire(
        "- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: make_voxels, id: finer}\n"
        "- {pass: show_faces, inputs: {voxels: make_voxels}}\n");
}

TEST(GraphBasis, OtherVoxelsAreRefused) {
    const std::string message = errorOf<UsageError>([] {
        wire(
            "- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: make_voxels, id: finer}\n"
            "- {pass: show_faces}\n");
    });
    EXPECT_CONTAINS(message,
                    "g.yaml:4: show_faces: 'faces' of 'light_faces' belongs to the voxels of "
                    "'make_voxels', but show_faces reads those of 'finer'");
    EXPECT_CONTAINS(message,
                    "write 'inputs: {voxels: make_voxels}' here, or put 'finer' before 'light_faces'");
}

TEST(GraphBasis, IsHandedOnByPassesThatChangeWhatTheyRead) {
    const std::string message = errorOf<UsageError>([] {
        wire(
            "- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: smooth_faces}\n"
            "- {pass: make_voxels, id: finer}\n- {pass: show_faces}\n");
    });
    EXPECT_CONTAINS(message, "'faces' of 'smooth_faces' belongs to the voxels of 'make_voxels'");
}

}  // namespace
}  // namespace voxray
