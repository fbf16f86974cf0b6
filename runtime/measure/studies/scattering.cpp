/// What each way to scatter light costs, and how far it is from the exact convolution, on the face itself.

#include <cmath>

#include "runtime/effects/scattering.h"
#include "runtime/light/scatter_projection.h"
#include "runtime/measure/portrait.h"
#include "runtime/measure/studies.h"
#include "runtime/offscreen.h"

namespace blush {
namespace {

/// Side of the picture, and of what of it the exact twin computes on the CPU: it gathers some thousands of pixels for
/// each.
constexpr std::uint32_t side_pixels = 160, every = 4;
/// As far as the exact convolution reaches: 99.8 % of the six Gaussians' red light.
constexpr double reach_mm = 9;

struct StudiedSkin {
    Portrait character;
    Offscreen offscreen;
    ViewFrame view;
    SkinImage image;                // what shading left, read back
    std::vector<glm::dvec3> exact;  // of a variant's own profile: six Gaussians
    gl::Texture light, albedo, depth, scene, first, second, third, stencil;
    ScatterPasses passes;
    ScatterInput input;
};

gl::Texture texture(GLenum format) {
    gl::Texture made = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(made.name(), 1, format, side_pixels, side_pixels);
    glTextureParameteri(made.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(made.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(made.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return made;
}

/// Keeps what the scattering of a frame starts from. The passes read textures that the frame gives back, so copies.
void capture(StudiedSkin& scene) {
    CharacterState& state = scene.character.state();
    scene.light = texture(GL_RGBA16F);
    scene.albedo = texture(GL_RGBA16F);
    scene.depth = texture(GL_R32F);
    scene.scene = texture(GL_RGBA16F);
    scene.first = texture(GL_RGBA16F);
    scene.second = texture(GL_RGBA16F);
    scene.third = texture(GL_RGBA16F);
    scene.stencil = texture(GL_STENCIL_INDEX8);
    scene.character.frame().own<ScatterCapture>() = {scene.light.name(), scene.albedo.name(), scene.depth.name()};
    scene.character.draw(scene.view);
    scene.character.frame().own<ScatterCapture>() = {};
    const std::size_t pixels = std::size_t{side_pixels} * side_pixels;
    std::vector<glm::vec4> light(pixels);
    std::vector<float> depth(pixels);
    glGetTextureImage(scene.light.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(pixels * sizeof(light[0])),
                      light.data());
    glGetTextureImage(scene.depth.name(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(pixels * sizeof(depth[0])),
                      depth.data());
    scene.image.width = scene.image.height = side_pixels;
    scene.image.light.assign(light.begin(), light.end());
    scene.image.depth_mm.assign(depth.begin(), depth.end());
    scene.input.light = scene.light.name();
    scene.input.albedo = scene.albedo.name();
    scene.input.depth = scene.depth.name();
    scene.input.width = scene.input.height = side_pixels;
    scene.input.projection = scatter_projection(scene.character.frame(), state.millimetres_a_unit);
    scene.input.follow_mm = scatter_follow_mm(scene.character.frame(), state);
    scene.exact = scatter_exact(scene.image, skin_six_gaussians(), scene.input.projection, scene.input.follow_mm,
                                reach_mm, every);
}

/// A close view: the face's skin fills the picture, so that a millimetre has several pixels.
std::shared_ptr<StudiedSkin> make_scene(const Device& device, const Face& face, double millimetres_a_unit) {
    Result<Portrait> character = Portrait::create(device, face);
    Result<Offscreen> offscreen = Offscreen::create(device, side_pixels, side_pixels, Output::linear_hdr);
    if (!character || !offscreen) return nullptr;
    if (Status set = character->set("scattering.millimetres_a_unit", std::to_string(millimetres_a_unit)); !set)
        return nullptr;
    auto scene = std::make_shared<StudiedSkin>(
        StudiedSkin{*std::move(character), *std::move(offscreen), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}});
    scene->view = scene->offscreen.view();
    OrbitCamera orbit = scene->character.framing(1);
    orbit.distance *= 0.3F;
    scene->view.camera = orbit.camera(1);
    scene->view.samples = 1;
    capture(*scene);
    return scene;
}

/// Error of the light that leaves the skin, over all channels, in hundredths of the mean light.
Variant::Error error_of(StudiedSkin& scene) {
    std::vector<glm::vec4> out(scene.exact.size());
    glGetTextureImage(scene.scene.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(out.size() * sizeof(out[0])),
                      out.data());
    std::vector<glm::vec4> albedo(out.size());
    glGetTextureImage(scene.albedo.name(), 0, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(albedo.size() * sizeof(albedo[0])), albedo.data());
    Variant::Error error;
    double count = 0;
    glm::dvec3 light(0);
    for (std::size_t p = 0; p < out.size(); ++p) {
        if (p % side_pixels % every != 0 || p / side_pixels % every != 0 || !(scene.image.light[p].a > 0)) continue;
        for (glm::length_t c = 0; c < 3; ++c) {
            const double reflected = scene.exact[p][c] * static_cast<double>(albedo[p][c]);
            const double difference = std::abs(static_cast<double>(out[p][c]) - reflected);
            const auto channel = static_cast<std::size_t>(c);
            error.channel_mean[channel] += difference;
            error.channel_worst[channel] = std::max(error.channel_worst[channel], difference);
            light[c] += reflected;
        }
        ++count;
    }
    // Of all channels: against their mean, so that a dark blue does not count as
    // much as a bright red.
    const double all = light.r + light.g + light.b;
    for (std::size_t c = 0; c < 3; ++c) {
        error.mean += all > 0 ? 100 * error.channel_mean[c] / all : 0;
        error.worst = std::max(error.worst, all > 0 ? 300 * count * error.channel_worst[c] / all : 0);
        const double own = light[static_cast<glm::length_t>(c)];
        error.channel_mean[c] *= own > 0 ? 100 / own : 0;
        error.channel_worst[c] *= own > 0 ? 100 * count / own : 0;
    }
    return error;
}

void clear(const StudiedSkin& scene) { glClearTexImage(scene.scene.name(), 0, GL_RGBA, GL_FLOAT, nullptr); }

}  // namespace

std::vector<Study> studies::scattering(const Device& device, const Face& face, double millimetres_a_unit,
                                       bool /*quick*/) {
    std::shared_ptr<StudiedSkin> scene = make_scene(device, face, millimetres_a_unit);
    if (!scene || scene->character.state().facts_of_face.skin.parts.empty()) return {};
    std::size_t skin = 0;
    for (const glm::dvec4& light : scene->image.light) skin += light.a > 0 ? 1U : 0U;
    const double pixels_a_mm = scene->character.state().skin.pixels_a_mm;
    Study study{
        "a close view of " + std::to_string(side_pixels) + "x" + std::to_string(side_pixels) + " pixels, " +
            std::to_string(skin) + " of them skin, up to " + std::to_string(pixels_a_mm).substr(0, 4) +
            " pixels a millimetre",
        "the exact two-dimensional convolution with six Gaussians in double precision (rig/light/scatter_image.h)",
        "% of the mean light",
        {},
        scene};
    const auto add = [&](std::string label, ScatterMethod method, std::uint32_t samples,
                         std::function<void(StudiedSkin&)> draw) {
        Variant variant;
        variant.label = std::move(label);
        variant.is_default = variant.label == "scattering.samples=17";
        variant.work = std::to_string(ScatterPasses::fetches_a_pixel(method, samples, scene->input.follow_mm > 0)) +
                       " fetches a pixel of skin";
        StudiedSkin* raw = scene.get();
        variant.run = [raw, draw] {
            clear(*raw);
            draw(*raw);
            glFinish();
        };
        variant.error = [raw, draw] {
            clear(*raw);
            draw(*raw);
            return error_of(*raw);
        };
        study.variants.push_back(std::move(variant));
    };
    const ScatterScratch scratch{scene->first.name(), scene->second.name(), scene->third.name(), scene->stencil.name()};
    for (const std::uint32_t samples : {9U, 17U, 25U, 33U}) {
        const std::vector<KernelTap> taps = preintegrated_kernel(skin_six_gaussians(), 1, samples);
        add("scattering.samples=" + std::to_string(samples), ScatterMethod::separable, samples,
            [taps, scratch](StudiedSkin& s) { s.passes.separable(s.input, taps, scratch, s.scene.name()); });
    }
    const std::vector<KernelTap> fitted = separable_kernel(scatter_kernel_shape(scene->character.state()), 17);
    add("scattering.kernel=fitted", ScatterMethod::separable, 17,
        [fitted, scratch](StudiedSkin& s) { s.passes.separable(s.input, fitted, scratch, s.scene.name()); });
    for (const ScatterMethod method : {ScatterMethod::gaussians4, ScatterMethod::gaussians6}) {
        const bool four = method == ScatterMethod::gaussians4;
        add(four ? "scattering.method=gaussians4" : "scattering.method=gaussians6", method, 0,
            [four, scratch](StudiedSkin& s) {
                s.passes.gaussians(s.input, four ? skin_four_gaussians() : skin_six_gaussians(), scratch,
                                   s.scene.name());
            });
    }
    const JitteredKernel jittered = jittered_kernel(skin_six_gaussians());
    add("scattering.method=jittered", ScatterMethod::jittered, 0,
        [jittered](StudiedSkin& s) { s.passes.jittered(s.input, jittered, s.scene.name()); });
    return {std::move(study)};
}

}  // namespace blush
