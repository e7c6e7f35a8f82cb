#pragma once

#include <glm/vec3.hpp>
#include <tuple>

#include "graph/pass.h"
#include "graph/registry.h"

namespace voxray {

/// Multiplies an image by a colour. The template of a pass: copy this folder to passes/<name>/.
class Tint final : public Pass {
 public:
    static constexpr const char* kName = "tint";
    static constexpr const char* kHelp =
        "Multiplies an image by a colour.\n"
        "Exact: no bias, no noise. Source: the template of docs/writing-a-pass.md.";

    struct Params {
        glm::vec3 color{1.0f};
        static constexpr auto schema() {
            return std::tuple{field("color", &Params::color, "Factor of each channel.", glm::vec3(0.0f),
                                    glm::vec3(1000.0f))};
        }
    };

    explicit Tint(const Params& params) : params_(params) {}

    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const FrameImage> source_;
    Port<FrameImage> final_;
    Program program_;
};

}  // namespace voxray
