// What a ray hit, in 32 bits: the surface group, its face, and whether it is nearer than `nearDistance`; or one of HIT_NOTHING,
// HIT_NO_GROUP, HIT_UNKNOWN. Clusters are not in it, so it holds until the ray's own voxel or something on its way changes.
//
//     bit 31         4   3      2    0
//        | group     | isNear | face |
#define HIT_NOTHING 0xffffffffu
#define HIT_NO_GROUP 0xfffffffeu  // A surface for which no surface group was found.
#define HIT_UNKNOWN 0xfffffffdu   // To be traced.
#define NO_FACE 6u                // The group has no area at a face that the ray may see.

uint packHit(uint group, uint face, bool isNear) { return 16u * group + (isNear ? 8u : 0u) + face; }

bool hitsGroup(uint packedHit) { return packedHit < 0xfffffff0u; }
uint hitGroup(uint packedHit) { return packedHit / 16u; }
uint hitFace(uint packedHit) { return packedHit & 7u; }
bool isNear(uint packedHit) { return (packedHit & 8u) != 0u; }
uint withGroup(uint packedHit, uint group) { return 16u * group + (packedHit & 15u); }
