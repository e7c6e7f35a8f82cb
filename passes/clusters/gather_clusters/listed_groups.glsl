// Index of the i-th surface group to process: all groups, or those of a list (LISTED).
#ifdef LISTED
readonly buffer ListedGroups { uint data[]; } listedGroups;
uint groupIndex(uint i) { return listedGroups.data[i]; }
#else
uint groupIndex(uint i) { return i; }
#endif
