// The frame before, moved along the velocities, is blended into this one: jimenez-2012, 10.4.4.
#include "srgb.glsl"

layout(binding = 0) uniform sampler2D image;       // both are decoded by their texture where they are sRGB:
layout(binding = 1) uniform sampler2D last_image;  // they are blended in linear light
layout(binding = 2) uniform sampler2D velocities;   // speed, x, y; of this frame
layout(binding = 3) uniform sampler2D speeds;       // filtered along with the image
layout(binding = 4) uniform sampler2D last_speeds;  // filtered along with last_image; bilinear
layout(binding = 5) uniform sampler2D last_depth;   // of last_image
layout(location = 0) uniform float falloff;         // K of equation 10.6
layout(location = 1) uniform bool encoded;          // the result is to be sRGB
layout(location = 2) uniform bool moves;            // false: every velocity and speed of this frame is zero
layout(location = 3) uniform bool moved;            // the same of the last frame
layout(location = 4) uniform bool rejects;          // what this frame does not see anew, moving alike
layout(location = 0) out vec4 result;

// Whether what the last frame has around `last_pixel` is what this frame has around `pixel`, moving alike: then the two
// differ by where in the pixel they were sampled, and by nothing else. Where they do not, a surface has moved away from
// before the one seen here, or has been blended with it by the filter. (Nehab 2007 finds a surface again by its depth.)
// asked: false saves the fetches.
bool seen_alike(bool asked, ivec2 pixel, vec2 velocity, ivec2 last_pixel, vec2 size) {
    int count = asked ? 9 : 0;
    // A twentieth of a pixel a frame is no motion: that far, a contour is in its place. The rest, as surfaces turn, and as
    // the eye forgives them that are fast, is a fiftieth of their speed.
    float slack = 0.05 + 0.02 * length(velocity * size);
    ivec2 most = ivec2(size) - 1;
    float lowest = 2.0, highest = -1.0;
    for (int i = 0; i < count; ++i) {
        vec4 near = texelFetch(velocities, clamp(pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), most), 0);
        vec2 apart = abs((near.yz - velocity) * size);
        bool alike = max(apart.x, apart.y) <= slack;
        lowest = alike ? min(lowest, near.w) : lowest;
        highest = alike ? max(highest, near.w) : highest;
    }
    // As steep as it is here, a surface may go on to the samples of the last frame.
    float tolerance = highest - lowest + 0.002 * highest + 1e-6;
    bool found = true;
    for (int i = 0; i < count; ++i) {
        ivec2 p = clamp(last_pixel + ivec2(i % 3, i / 3) - 1, ivec2(0), most);
        float before_far = 1.0 - texelFetch(last_depth, p, 0).r;
        found = found && before_far >= lowest - tolerance && before_far <= highest + tolerance;
    }
    return found;
}

// Bilinear by hand: bit for bit the texel itself where nothing moves.
vec4 last_color(vec2 position_pixels, ivec2 most) {
    vec2 corner = floor(position_pixels - 0.5), share = position_pixels - 0.5 - corner;
    int taps = share == vec2(0.0) ? 1 : 4;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < taps; ++i) {
        ivec2 tap = ivec2(i & 1, i >> 1);
        vec2 shares = mix(1.0 - share, share, vec2(tap));
        sum += shares.x * shares.y * texelFetch(last_image, clamp(ivec2(corner) + tap, ivec2(0), most), 0);
    }
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 own = texelFetch(image, pixel, 0);
    vec2 size = vec2(textureSize(image, 0));
    vec2 velocity = moves ? texelFetch(velocities, pixel, 0).yz : vec2(0.0);
    float speed = moves ? texelFetch(speeds, pixel, 0).r : 0.0;

    vec2 position = gl_FragCoord.xy - velocity * size;
    bool on_screen = all(greaterThanEqual(position, vec2(0.0))) && all(lessThanEqual(position, size));
    if (!on_screen) position = gl_FragCoord.xy;
    vec4 before = last_color(position, ivec2(size) - 1);
    // Equation 10.6. Of the root's argument the size counts: a speed that fell disoccludes as one that rose.
    float last_speed = moved ? textureLod(last_speeds, position / size, 0.0).r : 0.0;
    float weight = on_screen ? 0.5 * max(0.0, 1.0 - falloff * sqrt(abs(speed - last_speed))) : 0.0;
    // What is as bright within a hundredth leaves no ghost.
    bool differs = any(greaterThan(abs(own - before), 0.01 * max(own, before) + 1e-4));
    if (!seen_alike(rejects && differs && weight > 0.0, pixel, velocity, ivec2(position), size)) weight = 0.0;
    // Equation 10.7.
    vec4 color = (1.0 - weight) * own + weight * before;
    result = encoded ? vec4(srgb_from_linear(color.rgb), color.a) : color;
}
