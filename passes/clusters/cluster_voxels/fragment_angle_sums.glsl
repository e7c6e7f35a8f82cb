// Per voxel: sums of the angles between its fragments' normals and +x, +y and +z, and the number of fragments.
#define ANGLE_SUMS 4u
buffer FragmentAngleSums { uint data[]; } fragmentAngleSums;
