// The surface groups to process: all, or those on a list (LISTED).
#ifdef LISTED
readonly buffer ListedGroups { uint data[]; } listedGroups;
uint groupIndex(uint i) { return listedGroups.data[i]; }
#else
uint groupIndex(uint i) { return i; }
#endif
