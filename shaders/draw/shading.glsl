// All between interpolants and light, whoever draws: nothing here knows of pixels, samples or quads (a test compiles it as
// a compute shader). Each file stands on those above it. None includes what another one needs: an include in a branch that
// is not compiled counts as done.
#include "shared.glsl"
#insert uniforms
#include "vectors.glsl"
#include "draw/interpolants.glsl"
#include "draw/surface.glsl"
#include "draw/relief.glsl"
#include "draw/lighting.glsl"
#include "light/ambient.glsl"
#include "light/arriving.glsl"
#include "draw/ggx.glsl"
#include "draw/hooks.glsl"
#include "draw/material.glsl"
#include "draw/model.glsl"
