// What the surface half of a model fills and the lighting half reads: all that is known of a place, whatever drew it.
// Shading forward, deferred and in texture space differ only in where the record comes from and where the light goes.

// Which lighting a record is for.
const int model_plain = 0, model_skin = 1, model_eye = 2, model_mouth = 3, model_hair = 4;

// 33 floats. A G-buffer keeps 20, most of them in 8 bits: depth gives position and footprint back, the triangle the vertex
// normal, layout_uv and visibility. In texture space layout_uv is the place in the image itself.
struct Surface {
    int model;
    vec3 position;       // world
    vec3 vertex_normal;  // unit, world, towards the side that is seen
    float footprint;     // world units from a pixel to the next, across and down together
    vec2 layout_uv;      // place in the face's layout
    vec4 visibility;     // rgb: share of the ambient light that arrives; a: of the directions that are open
    vec3 normal;         // the vertex normal as maps bend it
    vec3 base_color;     // linear
    float opacity;
    float metallic;
    float roughness;
    float specular;      // factor on what a surface that is no metal reflects (KHR_materials_specular)
    float occlusion;     // share of the ambient light that the material's map leaves
    vec3 along;          // unit: of hair its strand's direction, of an eye the normal of the iris; else the normal
    float exposed;       // share of the light that lids, lips or other strands leave
    float scatter;       // how far light goes below, as share of its whole reach
    vec3 emitted;        // radiance, linear
};

vec3 towards_camera(vec3 position) { return unit_or(camera_world.xyz - position, vec3(0.0, 0.0, 1.0)); }

// Grazing pixels of interpolated normals may face away; the clamp keeps divisors above zero.
float cosine_to_view(Surface s, vec3 view) { return max(dot(s.normal, view), 1e-3); }

vec3 diffuse_color(Surface s) { return s.base_color * (1.0 - s.metallic); }
