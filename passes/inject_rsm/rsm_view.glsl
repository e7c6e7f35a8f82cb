// A light's view of the scene, square; as in inject_rsm.cpp. Push constants of all its shaders.
layout(push_constant, scalar) uniform Push {
    vec3 origin;       // The light, or the middle of the disc that parallel light starts from.
    float halfExtent;  // Of the view: m for parallel light, else at a distance of 1 m.
    vec3 right;
    float near;        // m
    vec3 up;
    float far;         // m
    vec3 forward;
    uint parallel;
    uint light;
    uint resolution;  // Texels a side.
    uint firstTexel;
    uint texels;
} push;
