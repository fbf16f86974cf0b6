#pragma once
// What a host and the library hand each other, asked of either side: library.cpp is compiled as the library is,
// host.cpp with one of GLM's macros.

#include <cstddef>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/controls/rig.h"
#include "rig/face.h"
#include "rig/light/diffusion_profile.h"
#include "rig/light/scatter_image.h"
#include "rig/wrinkles/surface_strain.h"
#include "rig/wrinkles/uv_raster.h"
#include "runtime/camera.h"
#include "runtime/lighting.h"
#include "runtime/view.h"

namespace blush::test {

#define SIZE(type) sizeof(type), alignof(type)
#define PLACE(type, member) offsetof(type, member)

// static: either side has its own.
static std::vector<std::size_t> layout() {
    return {SIZE(Vec2), SIZE(Vec3), SIZE(Vec4), SIZE(DVec2), SIZE(DVec3), SIZE(DVec4), SIZE(IVec2), SIZE(IVec4),
            SIZE(UVec3), SIZE(U8Vec2), SIZE(U8Vec4), SIZE(U16Vec4), SIZE(Mat3), SIZE(Mat4), SIZE(DMat3), SIZE(Quat),
            // In the order of the members; the last of each tells of all before it.
            SIZE(Transform), PLACE(Transform, rotation), PLACE(Transform, scale), PLACE(Quat, w), PLACE(Quat, z),
            SIZE(Node), PLACE(Node, matrix), PLACE(Node, file_index), SIZE(TextureUse), PLACE(TextureUse, repeat_v),
            SIZE(Material), PLACE(Material, emissive_linear), PLACE(Material, specular_map), SIZE(Target), SIZE(Face),
            PLACE(Face, notes), SIZE(Pose), PLACE(Pose, scratch), SIZE(Bounds), PLACE(Bounds, high), SIZE(Pivot),
            SIZE(HeadAndEyes), SIZE(GaussianTerm), SIZE(SkinImage), SIZE(Stretch), SIZE(PrincipalCompression),
            SIZE(Camera), PLACE(Camera, clip_from_view), SIZE(ViewFrame), PLACE(ViewFrame, background_linear),
            SIZE(LightSource), PLACE(LightSource, radiance_linear), SIZE(Lighting),
            PLACE(Lighting, environment_turn_radians)};
}

std::vector<std::size_t> layout_of_library();

/// The same numbers by value, in and out: they travel in registers that depend on the type.
Vec2 handed_on(Vec2 v);
Vec3 handed_on(Vec3 v);
Vec4 handed_on(Vec4 v);
DVec3 handed_on(DVec3 v);
Quat handed_on(Quat q);

/// Reads a rotation of w = 1, x = 2, y = 3, z = 4 member by member.
bool reads(const Transform& transform);
/// Those of GLM's functions that its macros turn round, as the library calls them.
Mat4 camera_of_library();

}  // namespace blush::test
