// Kinds of a material's textures, bits, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_TEXTURE_KINDS_H
#define VOXRAY_SHARED_TEXTURE_KINDS_H

#define BASE_COLOR_TEXTURES 1u
#define METALLIC_ROUGHNESS_TEXTURES 2u
#define NORMAL_TEXTURES 4u
#define EMISSIVE_TEXTURES 8u

#endif
