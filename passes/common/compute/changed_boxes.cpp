#include "passes/common/compute/changed_boxes.h"

namespace voxray {

Buffer changedBoxes(CommandStream& stream, const std::vector<Box>& changed, float voxelSize) {
    const glm::vec3 margin(voxelSize / 64);
    std::vector<Box> boxes(1, Box::empty());
    for (const Box& box : changed) {
        boxes[0].include(box);
        boxes.push_back(box);
    }
    for (Box& box : boxes) box = {box.min - margin, box.max + margin};
    Buffer buffer(stream.device(), "changed boxes", boxes.size() * sizeof(Box));
    stream.upload(buffer, boxes);
    return buffer;
}

}  // namespace voxray
