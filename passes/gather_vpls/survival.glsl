// The chance that a path goes on from where so much of the light is reflected.
float survival(vec3 reflectance) { return min(max(reflectance.r, max(reflectance.g, reflectance.b)), 1.0); }
