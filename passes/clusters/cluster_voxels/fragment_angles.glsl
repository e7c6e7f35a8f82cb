// By voxel: sums of the angles of its fragments' normals to +x, +y and +z, and the number of fragments.
#define ANGLE_SUMS 4u
buffer FragmentAngles { uint data[]; } fragmentAngles;
