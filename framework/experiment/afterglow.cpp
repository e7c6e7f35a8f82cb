#include "experiment/afterglow.h"

#include "base/error.h"

namespace voxray {

void scoreAfterglow(std::span<const FrameMeans> means, uint32_t offAt, const std::string& light,
                    std::span<FrameScores> frames) {
    if (means.size() != frames.size()) throw Error("means of {} frames for {}", means.size(), frames.size());
    uint32_t lit = 0;
    double before = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].frame < offAt) {
            before = means[i].reference;
            continue;
        }
        const double lost = before - means[i].reference;
        if (!(lost > 0)) continue;
        const double afterglow = (means[i].test - means[i].reference) / lost;
        if (afterglow > kVisibleFraction) ++lit;
        frames[i].scores[light + "afterglow"] = afterglow;
        frames[i].scores[light + "frames_lit"] = lit;
    }
}

}  // namespace voxray
