// Pixels that an invocation of a level filters (level.glsl), shared by C++ and GLSL.
#ifndef VOXRAY_FILTER_STRIP_H
#define VOXRAY_FILTER_STRIP_H

#define STRIP_COLUMNS 2
#define STRIP_ROWS 8

#endif
