// What a host's own fragment shader has before its main(): `model_surface(interpolants())` is the record of the place,
// `model_lighting(record)` its light (draw/surface.glsl, draw/lighting.glsl say what is in them), `covered(opacity)` discards
// what is cut out.
#include "draw/shading.glsl"
#include "draw/coverage.glsl"
#include "draw/rasterised.glsl"
