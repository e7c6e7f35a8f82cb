// The sides that are gathered: all, or those on a list (SEEN).
#ifdef SEEN
readonly buffer Listed { uint data[]; } listed;
uint sideNumber(uint i) { return listed.data[i]; }
#else
uint sideNumber(uint i) { return i; }
#endif
