// What the fragments in each voxel tell of the way that it looks: sums of their angles to +x, +y and +z, and how many they are.
#define ANGLE_SUMS 4u
buffer FragmentAngles { uint data[]; } fragmentAngles;
