#include "tools/make_face/build_face.h"

#include <future>

#include "tools/make_face/expressions.h"
#include "tools/make_face/eyes.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/mouth_parts.h"
#include "tools/make_face/person_shape.h"
#include "tools/make_face/textures.h"

namespace blush::make_face {

FaceParts build_face(std::size_t vertices, const Person& person) {
    FaceParts face;
    Head head = make_head(vertices);
    grow_hair(head);
    // The shapes are worked out while the textures are painted and packed.
    std::future<std::vector<ShapeTarget>> shapes =
        std::async(std::launch::async, [&head] { return head_targets(head); });

    enum MaterialIndex : std::size_t { skin, eye, tooth, gum, tongue, lash };
    constexpr int skin_texture_side = 2048, pore_texture_side = 1024, eye_texture_side = 1024,
                  roughness_texture_side = 512;
    face.materials.resize(6);
    face.materials[skin] = {.name = "skin",
                            .roughness = 1,
                            .base_color_png = png(paint_skin(head, skin_texture_side)),
                            .normal_png = png(paint_pores(head, pore_texture_side)),
                            .roughness_png = png(paint_roughness(head, roughness_texture_side))};
    face.materials[eye] = {.name = "eye",
                           .roughness = 0.1,
                           .base_color_png = png(paint_eye(eye_texture_side)),
                           .normal_png = {},
                           .roughness_png = {}};
    face.materials[tooth] = {.name = "teeth",
                             .base_color_linear = {0.76, 0.69, 0.58, 1},
                             .roughness = 0.25,
                             .base_color_png = {},
                             .normal_png = {},
                             .roughness_png = {}};
    face.materials[gum] = {.name = "gums",
                           .roughness = 0.35,
                           .base_color_png = png(paint_gum(128)),
                           .normal_png = {},
                           .roughness_png = {}};
    face.materials[tongue] = {.name = "tongue",
                              .roughness = 0.4,
                              .base_color_png = png(paint_tongue(128)),
                              .normal_png = {},
                              .roughness_png = {}};
    face.materials[lash] = {.name = "lashes",
                            .base_color_linear = {0.012, 0.008, 0.006, 1},
                            .roughness = 0.6,
                            .base_color_png = {},
                            .normal_png = {},
                            .roughness_png = {},
                            .double_sided = true};

    face.nodes.push_back({.name = "head"});
    const auto add = [&](const std::string& name, const Mesh& mesh, MaterialIndex material,
                         std::vector<ShapeTarget> targets, const Vec3& place = Vec3(0)) {
        face.meshes.push_back({name, mesh, material, std::move(targets)});
        face.nodes.push_back({name, place, static_cast<int>(face.meshes.size() - 1)});
    };
    const std::vector<ShapeTarget> targets = shapes.get();
    const Lashes lashes = make_lashes(head);
    add("skin", head.mesh, skin, targets);
    add("lashes", lashes.mesh, lash, lash_targets(lashes, head, targets));

    const Mesh ball = make_eye();
    add("eyeLeft", ball, eye, {}, landmark::eye_centre);
    add("eyeRight", ball, eye, {}, mirrored(landmark::eye_centre));

    const Mesh lower_teeth = make_teeth(Jaw::lower), lower_gum = make_gum(Jaw::lower), body = make_tongue();
    add("teethUpper", make_teeth(Jaw::upper), tooth, {});
    add("gumUpper", make_gum(Jaw::upper), gum, {});
    add("teethLower", lower_teeth, tooth, mandible_targets(lower_teeth));
    add("gumLower", lower_gum, gum, mandible_targets(lower_gum));
    add("tongue", body, tongue, tongue_targets(body));
    reshape(face, PersonShape(person));
    return face;
}

}  // namespace blush::make_face
