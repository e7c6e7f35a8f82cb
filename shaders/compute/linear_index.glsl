// Index of this thread among the work groups that linearGroups() in passes/common/compute/dispatch.h lays out.
uint linearIndex() { return gl_GlobalInvocationID.y * (32768u * 64u) + gl_GlobalInvocationID.x; }
