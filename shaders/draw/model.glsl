// The surface model of this permutation: what it fills the record with, and how it is lit.

#if defined(SKIN)
#include "draw/skin.glsl"
Surface model_surface(Interpolants at) { return skin_surface(at); }
Lighting model_lighting(Surface s) { return skin_lighting(s); }
#elif defined(EYE)
#include "draw/eye.glsl"
Surface model_surface(Interpolants at) { return eye_surface(at); }
Lighting model_lighting(Surface s) { return eye_lighting(s); }
#elif defined(MOUTH)
#include "draw/mouth.glsl"
Surface model_surface(Interpolants at) { return mouth_surface(at); }
Lighting model_lighting(Surface s) { return mouth_lighting(s); }
#elif defined(HAIR)
#include "draw/hair.glsl"
Surface model_surface(Interpolants at) { return hair_surface(at); }
Lighting model_lighting(Surface s) { return hair_lighting(s); }
#else
#include "draw/plain.glsl"
Surface model_surface(Interpolants at) { return plain_surface(at); }
Lighting model_lighting(Surface s) { return plain_lighting(s); }
#endif
