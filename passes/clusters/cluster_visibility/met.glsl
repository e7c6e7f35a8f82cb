// What a ray met, in a word: a face of a side, and whether it is nearer than `nearDistance`; or one of the words below. It holds as long
// as neither the ray's own voxel nor what the ray meets on its way changes: clusters have no part in it.
#define MET_NOTHING 0xffffffffu
#define MET_NO_SIDE 0xfffffffeu  // A surface that no side was found for.
#define MET_UNKNOWN 0xfffffffdu  // Yet to be traced.
#define NO_FACE 6u               // For the face: the side has area at none that the ray may see.

uint metSide(uint side, uint face, bool isNear) { return 16u * side + (isNear ? 8u : 0u) + face; }

bool isSide(uint met) { return met < 0xfffffff0u; }
uint sideOf(uint met) { return met / 16u; }
uint faceMet(uint met) { return met & 7u; }
bool isNear(uint met) { return (met & 8u) != 0u; }
uint withSide(uint met, uint side) { return 16u * side + (met & 15u); }
