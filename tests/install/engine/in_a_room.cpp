// Two characters stand in an engine's own room, through the installed library: they hide and are hidden, light and
// shadow pass both ways, and what is the engine's stays the engine's. usage: in_a_room FACE.glb PICTURE.png

#include <epoxy/egl.h>

#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "room.h"
#include "runtime/files/output_file.h"
#include "runtime/scene.h"

namespace {

using Picture = std::vector<std::uint8_t>;

/// Exit status 1 with a sentence.
int fail(const std::string& message) {
    std::fprintf(stderr, "in_a_room: %s\n", message.c_str());
    return 1;
}

bool make_context() {
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    eglInitialize(display, nullptr, nullptr);
    eglBindAPI(EGL_OPENGL_API);
    constexpr std::array<EGLint, 7> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    return eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
}

enum Id : std::uint32_t { floor_id = 1, wall_id, pillar_id, beam_id, rod_id };

/// Metres; heads stand left and right of the origin.
const std::vector<room::Box> boxes = {
    {{-1.5F, -0.42F, -0.8F}, {1.5F, -0.4F, 1.2F}, {0.55F, 0.5F, 0.45F}, floor_id},
    {{-1.5F, -0.4F, -0.62F}, {1.5F, 1.2F, -0.6F}, {0.45F, 0.55F, 0.6F}, wall_id},
    {{-0.22F, -0.4F, 0.25F}, {-0.18F, 0.5F, 0.29F}, {0.6F, 0.3F, 0.2F}, pillar_id},
    {{-0.08F, 0.13F, 0.26F}, {0.1F, 0.16F, 0.29F}, {0.6F, 0.6F, 0.2F}, beam_id},
};
/// Drawn after the characters: behind the left one.
const std::vector<room::Box> later = {{{-0.62F, 0.02F, -0.2F}, {-0.02F, 0.05F, -0.17F}, {0.2F, 0.7F, 0.3F}, rod_id}};

const room::Lamp lamp = {{-1.2, 0.9, 1.6}, {1.2, -0.9, -1.6}, glm::vec3(2.2F, 2.0F, 1.8F), 2.2F, 0.45F};

struct Engine {
    blush::Device device;
    blush::FaceAsset asset;
    blush::Character left, right;
    blush::Scene scene;
    blush::View view;
    room::Renderer renderer;
    room::Target target;
    room::ShadowMap of_room, of_all;
};

blush::Lighting lighting(const Engine& engine, bool with_host_shadow) {
    blush::LightSource spot;
    spot.kind = blush::LightKind::spot;
    spot.position_world = lamp.position;
    spot.direction_world = glm::vec3(lamp.towards);
    spot.radiance_linear = lamp.radiance;
    spot.reference_distance = lamp.reference_distance;
    spot.outer_radians = lamp.outer_radians;
    spot.inner_radians = 0.9F * lamp.outer_radians;
    if (with_host_shadow) {
        spot.host_shadow.depth_texture = engine.of_room.texture();
        spot.host_shadow.clip_from_world = lamp.clip_from_world();
        spot.host_shadow.depth_convention.zero_to_one = true;
    }
    blush::Lighting result;
    result.lights = {spot};
    result.sky_radiance_linear = result.ground_radiance_linear = glm::vec3(0.06F);
    return result;
}

struct Drawn {
    Picture before, after, end;  ///< before and after the characters, and with what is drawn later
    std::vector<std::uint32_t> ids_before, ids_after, ids_end;
};

/// A frame of the engine. Nothing of the characters where `alone`.
Drawn draw(Engine& engine, bool with_host_shadow, bool alone = false) {
    Drawn drawn;
    const glm::mat4 view_from_world = glm::lookAtRH(glm::vec3(0, 0.08F, 1.9F), glm::vec3(0), glm::vec3(0, 1, 0));
    const float aspect = static_cast<float>(room::width) / static_cast<float>(room::height);
    const glm::mat4 clip_from_view = glm::perspectiveRH_NO(0.48F, aspect, 0.1F, 10.0F);
    engine.of_room.clear();
    engine.renderer.draw_depth(boxes, lamp.clip_from_world(), engine.of_room);
    engine.of_all.copy_from(engine.of_room);
    if (!alone) {
        blush::DepthFrame depth;
        depth.clip_from_world = lamp.clip_from_world();
        depth.depth_convention.zero_to_one = true;
        depth.width = depth.height = room::map_side;
        depth.framebuffer = engine.of_all.framebuffer();
        engine.scene.draw_depth(depth);
    }
    const glm::mat4 clip_from_world = clip_from_view * view_from_world;
    engine.target.clear();
    engine.renderer.draw(boxes, clip_from_world, lamp, engine.of_all, engine.target);
    drawn.before = engine.target.colour();
    drawn.ids_before = engine.target.ids();
    if (!alone) {
        engine.scene.set_lighting(lighting(engine, with_host_shadow));
        blush::ViewFrame frame;
        frame.camera = {glm::dmat4(view_from_world), clip_from_view};
        frame.width = room::width;
        frame.height = room::height;
        frame.framebuffer = engine.target.name();
        frame.backdrop = blush::Backdrop::keep;
        frame.host_depth = blush::HostDepth::read_and_write;
        const blush::FrameReport& report = engine.scene.draw(engine.view, frame);
        if (report.failure) fail(*report.failure);
    }
    drawn.after = engine.target.colour();
    drawn.ids_after = engine.target.ids();
    engine.renderer.draw(later, clip_from_world, lamp, engine.of_all, engine.target);
    drawn.end = engine.target.colour();
    drawn.ids_end = engine.target.ids();
    return drawn;
}

float brightness(const Picture& picture, std::size_t pixel) {
    return static_cast<float>(picture[4 * pixel] + picture[4 * pixel + 1] + picture[4 * pixel + 2]) / 3;
}

bool same(const Picture& a, const Picture& b, std::size_t pixel) {
    return std::equal(&a[4 * pixel], &a[4 * pixel] + 4, &b[4 * pixel]);
}

/// What must hold of the pictures, each with the number of pixels that tell it.
int check(const Drawn& shown, const Drawn& unshadowed, const Drawn& alone) {
    if (shown.ids_after != shown.ids_before) return fail("the engine's second attachment was written");
    std::size_t of_faces = 0, on_pillar = 0, shaded_by_host = 0, brighter = 0, on_room = 0, rod_hidden = 0, rod = 0;
    for (std::size_t p = 0; p < std::size_t{room::width} * room::height; ++p) {
        const bool face = !same(shown.before, shown.after, p);
        of_faces += face ? 1 : 0;
        if (face && shown.ids_before[p] == pillar_id) ++on_pillar;
        if (face && brightness(unshadowed.after, p) > brightness(shown.after, p) + 20) ++shaded_by_host;
        if (face && brightness(unshadowed.after, p) < brightness(shown.after, p) - 20) ++brighter;
        if (!face && brightness(alone.before, p) > brightness(shown.before, p) + 20) ++on_room;
        if (alone.ids_end[p] == rod_id) {
            ++rod;
            if (shown.ids_end[p] != rod_id && face) ++rod_hidden;
        }
    }
    std::printf(
        "in_a_room: pixels of faces %zu, of the pillar that they changed %zu, shaded by the room %zu, of the room "
        "that they shade %zu, of the rod that they hide %zu of %zu\n",
        of_faces, on_pillar, shaded_by_host, on_room, rod_hidden, rod);
    if (of_faces < 20000) return fail("the faces are not to be seen");
    if (on_pillar > 60) return fail("the pillar does not hide the face behind it");  // its edges are not multisampled
    if (shaded_by_host < 500) return fail("the room casts no shadow on a face");
    if (brighter > 50) return fail("a shadow of the room's lights a face");
    if (on_room < 2000) return fail("the faces cast no shadow into the room");
    if (rod_hidden < 200 || rod_hidden == rod) return fail("what is drawn later is not hidden by the faces alone");
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return fail("usage: in_a_room FACE.glb PICTURE.png");
    if (!make_context()) return fail("no GL context");
    blush::Result<blush::Device> device = blush::Device::adopt_current();
    if (!device) return fail(device.error().message);
    blush::Result<blush::FaceAsset> asset = blush::FaceAsset::load(argv[1]);
    if (!asset) return fail(asset.error().message);
    Engine engine{*device,
                  *asset,
                  *blush::Character::create(*device, *asset),
                  *blush::Character::create(*device, *asset),
                  *blush::Scene::create(*device),
                  *blush::View::create(*device),
                  {},
                  {},
                  {},
                  {}};
    const glm::dvec3 middle(asset->framing(1).target_world);
    engine.left.place(glm::translate(glm::dmat4(1), glm::dvec3(-0.28, 0, 0) - middle));
    engine.right.place(glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(0.28, 0, 0)), -0.35, glm::dvec3(0, 1, 0)) *
                       glm::translate(glm::dmat4(1), -middle));
    for (const auto& [character, control, value] : {std::tuple(&engine.left, "mouthSmileLeft", 0.8F),
                                                    {&engine.left, "mouthSmileRight", 0.8F},
                                                    {&engine.right, "browInnerUp", 0.9F},
                                                    {&engine.right, "jawOpen", 0.2F}}) {
        if (const auto id = character->control(control)) character->set(*id, value);
    }
    if (!engine.scene.add(engine.left) || !engine.scene.add(engine.right)) return fail("not added");

    const Drawn shown = draw(engine, true), unshadowed = draw(engine, false), alone = draw(engine, true, true);
    blush::Image image;
    image.width = room::width;
    image.height = room::height;
    image.channels = 4;
    for (std::uint32_t y = room::height; y-- > 0;) {
        const auto row = shown.end.begin() + static_cast<std::ptrdiff_t>(4 * y * room::width);
        image.bytes.insert(image.bytes.end(), row, row + 4 * room::width);
    }
    if (const blush::Status written = blush::write_image(argv[2], image); !written) {
        return fail(written.error().message);
    }
    return check(shown, unshadowed, alone);
}
