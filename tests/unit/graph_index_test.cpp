// What is indexed by voxels is read together with these voxels alone.
#include <gtest/gtest.h>

#include "config/yaml.h"
#include "graph/graph.h"
#include "tests/support/errors.h"

namespace voxray {
namespace {

struct Voxels : Resource {};
struct Faces : Resource {
    std::string indexedBy() const override { return "voxels"; }
};

// A pass that does nothing but have ports.
struct Idle : Pass {
    static constexpr const char* kHelp = "Has ports.";
    void plan(PassPlan&) override {}
    void record(PassContext&) override {}
};

struct MakeVoxels : Idle {
    static constexpr const char* kName = "make_voxels";
    Out<Voxels> voxels{*this, "voxels", "the voxels"};
};

struct LightFaces : Idle {
    static constexpr const char* kName = "light_faces";
    In<Voxels> voxels{*this, "voxels", "voxels to light"};
    Out<Faces> faces{*this, "faces", "light of their faces"};
};

struct SmoothFaces : Idle {
    static constexpr const char* kName = "smooth_faces";
    In<Faces> before{*this, "faces", "light to smooth"};
    Out<Faces> faces{*this, "faces", "smooth light"};
};

struct ShowFaces : Idle {
    static constexpr const char* kName = "show_faces";
    In<Voxels> voxels{*this, "voxels", "where faces are"};
    In<Faces> faces{*this, "faces", "their light"};
};

void wire(const std::string& yaml) {
    Registry registry;
    registry.add<MakeVoxels>();
    registry.add<LightFaces>();
    registry.add<SmoothFaces>();
    registry.add<ShowFaces>();
    Graph(registry, parseYaml(yaml, "g.yaml"));
}

TEST(GraphIndex, LightIsReadWithItsOwnVoxels) {
    wire("- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: show_faces}\n");
    wire("- {pass: make_voxels}\n- {pass: make_voxels, id: finer}\n- {pass: light_faces}\n- {pass: show_faces}\n");
    wire(
        "- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: make_voxels, id: finer}\n"
        "- {pass: show_faces, inputs: {voxels: make_voxels}}\n");
}

TEST(GraphIndex, OtherVoxelsAreRefused) {
    const std::string message = errorOf<UsageError>([] {
        wire(
            "- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: make_voxels, id: finer}\n"
            "- {pass: show_faces}\n");
    });
    EXPECT_CONTAINS(message, "g.yaml:4: show_faces: ");
    EXPECT_CONTAINS(message, "'finer'");
}

TEST(GraphIndex, IsHandedOnByPassesThatChangeWhatTheyRead) {
    const std::string message = errorOf<UsageError>([] {
        wire(
            "- {pass: make_voxels}\n- {pass: light_faces}\n- {pass: smooth_faces}\n"
            "- {pass: make_voxels, id: finer}\n- {pass: show_faces}\n");
    });
    EXPECT_CONTAINS(message, "'faces'");
}

}  // namespace
}  // namespace voxray
