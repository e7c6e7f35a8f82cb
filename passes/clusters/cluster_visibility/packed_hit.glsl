// The hit of a ray in 32 bits: the surface group, its face, and whether it is nearer than `nearDistance`; or one of
// HIT_NOTHING, HIT_NO_GROUP and HIT_UNKNOWN. It does not refer to clusters, so it is valid until surfaces at the ray's
// origin, on its path or at its hit change.
//
//     bit 31         4   3      2    0
//        | group     | isNear | face |
#define HIT_NOTHING 0xffffffffu
#define HIT_NO_GROUP 0xfffffffeu  // A surface to which no surface group could be assigned.
#define HIT_UNKNOWN 0xfffffffdu   // The ray has to be traced.
#define NO_FACE 6u                // The group has no area at any of the faces visible to the ray.

uint packHit(uint group, uint face, bool isNear) { return 16u * group + (isNear ? 8u : 0u) + face; }

bool hitsGroup(uint packedHit) { return packedHit < 0xfffffff0u; }
uint hitGroup(uint packedHit) { return packedHit / 16u; }
uint hitFace(uint packedHit) { return packedHit & 7u; }
bool isNear(uint packedHit) { return (packedHit & 8u) != 0u; }
uint withGroup(uint packedHit, uint group) { return 16u * group + (packedHit & 15u); }
