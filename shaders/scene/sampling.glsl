// Random and low-discrepancy numbers, directions and frames.
#ifndef VOXRAY_SAMPLING_GLSL
#define VOXRAY_SAMPLING_GLSL

#define PI 3.14159265358979

// Integer hash with low bias (Wellons, "lowbias32").
uint hash(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

uint hashCombine(uint seed, uint value) {
    return hash(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2)));
}

// 24 random bits as a float in [0, 1).
float toUnit(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

// Owen scrambling by hash, after Laine and Karras 2011 with the constants of Burley 2020, section 3.
uint owenScramble(uint bits, uint seed) {
    bits = bitfieldReverse(bits);
    bits += seed;
    bits ^= bits * 0x6c50b47cu;
    bits ^= bits * 0xb82f1e52u;
    bits ^= bits * 0xc7afe638u;
    bits ^= bits * 0x8d22f6e6u;
    return bitfieldReverse(bits);
}

// Second dimension of the Sobol sequence; the first is the bit reversal of the index.
uint sobolSecond(uint index) {
    uint direction = 0x80000000u;
    uint result = 0u;
    for (; index != 0u; index >>= 1) {
        if ((index & 1u) != 0u) result ^= direction;
        direction ^= direction >> 1;
    }
    return result;
}

// Point `index` of a two-dimensional Owen-scrambled Sobol set, in [0, 1)². Different seeds give independent sets
// in independent order (Burley 2020, section 5: shuffled scrambled padding).
vec2 sobol2(uint index, uint seed) {
    const uint shuffled = owenScramble(index, hash(seed ^ 0xa511e9b3u));
    return vec2(toUnit(owenScramble(bitfieldReverse(shuffled), hash(seed ^ 0x63d83595u))),
                toUnit(owenScramble(sobolSecond(shuffled), hash(seed ^ 0x9e3779b9u))));
}

// Two unit vectors that make a right-handed frame with n (Duff et al. 2017).
void frame(vec3 n, out vec3 tangent, out vec3 bitangent) {
    const float s = n.z >= 0.0 ? 1.0 : -1.0;
    const float a = -1.0 / (s + n.z);
    const float b = n.x * n.y * a;
    tangent = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    bitangent = vec3(b, s + n.y * n.y * a, -n.y);
}

// Cosine-distributed about n; density cos/PI.
vec3 cosineDirection(vec2 u, vec3 n) {
    vec3 t, b;
    frame(n, t, b);
    const float r = sqrt(u.x), phi = 2.0 * PI * u.y;
    return normalize(t * (r * cos(phi)) + b * (r * sin(phi)) + n * sqrt(max(0.0, 1.0 - u.x)));
}

// Uniform in a cone about n with the given cosine of its half angle; density 1 / (2 PI (1 - cosMax)).
vec3 coneDirection(vec2 u, vec3 n, float cosMax) {
    vec3 t, b;
    frame(n, t, b);
    const float c = mix(1.0, cosMax, u.x), s = sqrt(max(0.0, 1.0 - c * c)), phi = 2.0 * PI * u.y;
    return normalize(t * (s * cos(phi)) + b * (s * sin(phi)) + n * c);
}

vec3 sphereDirection(vec2 u) {
    const float z = 1.0 - 2.0 * u.x, r = sqrt(max(0.0, 1.0 - z * z)), phi = 2.0 * PI * u.y;
    return vec3(r * cos(phi), r * sin(phi), z);
}

// Uniform on a triangle, as barycentric weights of its second and third vertex (Heitz 2019).
vec2 trianglePoint(vec2 u) {
    float v = u.y, w = u.x;
    if (v > w) {
        w *= 0.5;
        v -= w;
    } else {
        v *= 0.5;
        w -= v;
    }
    return vec2(w, v);
}

float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

// Probability that a path continues (Russian roulette): the largest channel of the reflectance.
float survivalProbability(vec3 reflectance) { return min(max(reflectance.r, max(reflectance.g, reflectance.b)), 1.0); }

#endif
