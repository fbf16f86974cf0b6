// Depth from one convention to another: the host's into the scene's, or back. MULTISAMPLED: from the first of a pixel's
// samples.
#include "shared.glsl"

#ifdef MULTISAMPLED
layout(binding = 0) uniform sampler2DMS depth;
#else
layout(binding = 0) uniform sampler2D depth;
#endif
layout(location = 0) uniform ivec2 corner;    // of what is drawn to, pixels
layout(location = 1) uniform bool reversed;   // the host's near plane has depth 1

void main() {
    // With window depths from 0 to 1 the two clip spaces of GL differ in nothing else.
    float d = texelFetch(depth, ivec2(gl_FragCoord.xy) - corner, 0).r;
    gl_FragDepth = reversed ? 1.0 - d : d;
}
