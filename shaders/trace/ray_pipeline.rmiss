#include "shaders/trace/ray_types.h"

layout(location = 0) rayPayloadInEXT Hit payload;

void main() { payload.triangle = NO_HIT; }
