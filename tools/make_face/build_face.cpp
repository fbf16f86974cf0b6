#include "tools/make_face/build_face.h"

#include <future>

#include "tools/make_face/brow_cards.h"
#include "tools/make_face/expressions.h"
#include "tools/make_face/eyes.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/hair_cards.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/lash_cards.h"
#include "tools/make_face/mouth_parts.h"
#include "tools/make_face/person_shape.h"
#include "tools/make_face/pigments.h"
#include "tools/make_face/skin_detail.h"
#include "tools/make_face/strands.h"
#include "tools/make_face/textures.h"

namespace blush::make_face {

FaceParts build_face(std::size_t vertices, const Person& person, int texture_side) {
    FaceParts face;
    Head head = make_head(vertices);
    grow_hair(head);
    // The shapes are worked out while the textures are painted and packed.
    std::future<std::vector<ShapeTarget>> shapes =
        std::async(std::launch::async, [&head] { return head_targets(head); });

    enum MaterialIndex : std::size_t { skin, eye, tooth, gum, tongue, lash, brow, hair, caruncle };
    const int eye_texture_side = texture_side * 2 / 3;
    face.materials.resize(9);
    const double aged = smooth_step(35, 75, person.shape[*parameter_index("age")]);
    const SkinColourTable table;
    const SurfaceTexels texels(head, texture_side), coarse_texels(head, texture_side / 2);
    face.pigments = paint_pigments(texels, person.skin, table);
    face.materials[skin] = {.name = "skin",
                            .roughness = 1,
                            .base_color_png = png(base_color(*face.pigments, table)),
                            .normal_png = png(paint_relief(texels, aged)),
                            .roughness_png = png(paint_roughness(coarse_texels)),
                            .specular_png = png(paint_specular(coarse_texels)),
                            .occluded = true};
    face.materials[eye] = {
        .name = "eye", .roughness = 0.1, .base_color_png = png(paint_eye(eye_texture_side, vec3(person.skin.eyes)))};
    face.materials[caruncle] = {.name = "caruncle", .base_color_linear = {0.46, 0.17, 0.14, 1}, .roughness = 0.2};
    face.materials[tooth] = {.name = "teeth", .roughness = 0.25, .base_color_png = png(paint_teeth(64))};
    face.materials[gum] = {.name = "gums", .roughness = 0.35, .base_color_png = png(paint_gum(128))};
    face.materials[tongue] = {.name = "tongue", .roughness = 0.4, .base_color_png = png(paint_tongue(128))};
    const auto strands = [&](const char* name, double darker, const Picture& picture) {
        const Vec3 color = linear_srgb(vec3(person.skin.hair)) * darker;
        return MaterialPart{.name = name,
                            .base_color_linear = {color.x, color.y, color.z, 1},
                            .roughness = 0.92,
                            .base_color_png = png(picture),
                            .double_sided = true,
                            .blended = true};
    };
    face.materials[hair] = strands("hair", 1, paint_hair_strands(512));
    face.materials[hair].double_sided = false;  // its strips have triangles for both sides
    face.materials[brow] = strands("brows", 0.55, paint_brow_strands(128));
    face.materials[lash] = strands("lashes", 0.08, paint_lash_strands(128));

    face.nodes.push_back({.name = "head"});
    const auto add = [&](const std::string& name, const Mesh& mesh, MaterialIndex material,
                         std::vector<ShapeTarget> targets, const Vec3& place = Vec3(0)) {
        face.meshes.push_back({name, mesh, material, std::move(targets)});
        face.nodes.push_back({name, place, static_cast<int>(face.meshes.size() - 1)});
    };
    const std::vector<ShapeTarget> targets = shapes.get();
    add("skin", head.mesh, skin, targets);

    const Mesh ball = make_eye();
    add("eyeLeft", ball, eye, {}, landmark::eye_centre);
    add("eyeRight", ball, eye, {}, mirrored(landmark::eye_centre));

    add("caruncles", make_caruncles(), caruncle, {});

    const Mesh lower_teeth = make_teeth(Jaw::lower), lower_gum = make_gum(Jaw::lower), body = make_tongue();
    add("teethUpper", make_teeth(Jaw::upper), tooth, {});
    add("gumUpper", make_gum(Jaw::upper), gum, {});
    add("teethLower", lower_teeth, tooth, mandible_targets(lower_teeth));
    add("gumLower", lower_gum, gum, mandible_targets(lower_gum));
    add("tongue", body, tongue, tongue_targets(body));

    // What blends is drawn in this order, over all that is solid.
    const Lashes lashes = make_lash_cards(head);
    add("lashes", lashes.mesh, lash, lash_targets(lashes, head, targets));
    const BrowCards brows = make_brow_cards(head);
    add("brows", brows.mesh, brow, carried_targets(brows.mesh, brows.anchors, head, targets));
    const HairCards strips = make_hair_cards();
    add("hair", strips.mesh, hair, carried_targets(strips.mesh, nearest_anchors(head, strips.roots), head, targets));
    reshape(face, PersonShape(person));
    return face;
}

}  // namespace blush::make_face
