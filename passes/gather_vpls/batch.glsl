// One batch: so many texels of a subset's image, and so many of the subset's virtual lights. Texels follow each other, then lights.
struct Batch {
    uvec2 texels;  // Of the G-buffer.
    uvec2 extent;  // Of the subset's image.
    uvec2 subset;  // Place within a block.
    uint block;
    uint firstTexel, texelCount;
    uint firstVpl, vplCount;  // Of the list of virtual lights.
};

// The G-buffer's texel of one of the batch; it may lie outside.
ivec2 batchTexel(Batch b, uint i) {
    const uint at = b.firstTexel + i;
    return ivec2(uvec2(at % b.extent.x, at / b.extent.x) * b.block + b.subset);
}

bool isOutside(Batch b, ivec2 texel) { return any(greaterThanEqual(texel, ivec2(b.texels))); }
