/// Subsurface scattering in screen space: the separable kernel of jimenez-2012, chapter 6, and its slower twins.

#include <array>
#include <cassert>

#include "rig/light/separable_kernel.h"
#include "runtime/effects/scattering.h"
#include "runtime/frame/frame.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 5> method_choices = {"separable", "gaussians4", "gaussians6", "jittered", "off"};
constexpr std::array<std::string_view, 4> sample_choices = {"9", "17", "25", "33"};
constexpr std::array<std::string_view, 2> kernel_choices = {"preintegrated", "fitted"};
// "skin", then measured_materials() of rig/light/diffusion_profile.h in its order.
constexpr std::array<std::string_view, 11> material_choices = {
    "skin", "marble", "skin1", "skin2", "wholemilk", "skimmilk", "potato", "apple", "ketchup", "cream", "chicken1"};
constexpr std::array<std::string_view, 2> follow_choices = {"on", "off"};

constexpr std::array<Setting, 14> settings = {{
    {"method",
     "separable: two passes (jimenez-2012, chapter 6); gaussians4, gaussians6: two passes for each but the narrowest "
     "(chapter 4); jittered: one pass of thirteen taps (4.2); off: light leaves where it entered",
     method_choices, 0},
    {"samples", "taps of a separable pass: 9, 17, 25 or 33, more of them for smoother edges of hard shadows",
     sample_choices, 1},
    {"kernel",
     "of the separable passes; preintegrated: the profile's integral along a line, twice as near to the convolution; "
     "fitted: eq. 6.1, of skin alone, with strengths and falloffs",
     kernel_choices, 0},
    {"material",
     "what light scatters in: skin (d'Eon and Luebke 2007), or, as Jensen et al. 2001 measured it: marble, skin1, "
     "skin2, wholemilk, skimmilk, potato, apple, ketchup, cream, chicken1",
     material_choices, 0},
    {"follow_surface", "on: light does not cross steps of depth; off: it does", follow_choices, 0},
    {"width", "how far light goes; 1: as the measured profile has it", {}, 0, 0.01, 10, 1.12},
    {"strength_red", "share of red light that enters; of the fitted kernel", {}, 0, 0, 1, 0.969},
    {"strength_green", "share of green light that enters", {}, 0, 0, 1, 1},
    {"strength_blue", "share of blue light that enters", {}, 0, 0, 1, 1},
    {"falloff_red", "reach of red, as a factor on the red profile", {}, 0, 0.01, 1, 0.58},
    {"falloff_green", "reach of green, as a factor on the red profile", {}, 0, 0.01, 1, 0.267},
    {"falloff_blue", "reach of blue, as a factor on the red profile", {}, 0, 0.01, 1, 0.215},
    {"albedo_before",
     "share of the albedo that light meets before it scatters, as an exponent; 0: sharpest, 1: softest",
     {},
     0,
     0,
     1,
     0.5},
    {"millimetres_a_unit", "scale of the face; 0: found from its size", {}, 0, 0, 1e6, 0},
}};

struct State {
    ScatterPasses passes;
    KernelShape shape;
    std::uint8_t kernel = 0, material = 0, jittered_material = 0;
    std::vector<KernelTap> taps;
    JitteredKernel jittered;
    ResourceId first{}, second{}, third{}, stencil{}, scene{};
};

double number(const CharacterState& state, std::string_view setting) {
    return state.settings.number("scattering", setting);
}

ScatterMethod method_of(const CharacterState& state) {
    return static_cast<ScatterMethod>(state.settings.choice("scattering", "method"));
}

bool of_skin(const CharacterState& state) { return state.settings.choice("scattering", "material") == 0; }

/// Eq. 6.1 is a fit to skin: what else light scatters in has its profile's integral.
bool is_fitted(const CharacterState& state) {
    return of_skin(state) && state.settings.choice("scattering", "kernel") == 1;
}

/// The width that the settings ask for, 1 for the profile's own millimetres.
double relative_width(const CharacterState& state) { return number(state, "width") / skin_kernel_shape().width; }

/// As far as the farthest tap.
double scatter_range_mm(const CharacterState& state) {
    if (is_fitted(state)) return kernel_range_mm(scatter_kernel_shape(state));
    return 3 * relative_width(state) * std::sqrt(scatter_profile(state).back().variance_mm2);
}

Need need(const CharacterState& state) {
    if (state.skin.parts.empty()) return {.on = false, .reason = "the face has no skin", .can_be_forced = false};
    if (method_of(state) == ScatterMethod::off) {
        return {.on = false, .reason = "scattering.method is off", .can_be_forced = false};
    }
    if (!state.skin.on_screen) return {.on = false, .reason = "no skin is on the screen"};
    if (state.lights.empty() && state.lighting->environment == nullptr &&
        state.lighting->sky_radiance_linear == glm::vec3(0) && state.lighting->ground_radiance_linear == glm::vec3(0)) {
        return {.on = false, .reason = "no light falls on the skin"};
    }
    if (scatter_range_mm(state) * state.skin.pixels_a_mm < 0.5) {
        // Every tap lies within the pixel. The bound: 0.1 of radiance, where a hard edge of light passes through it.
        return {.on = false,
                .reason = "the kernel ends within half a pixel of its centre",
                .omission = Omission::bounded,
                .bound = 0.1,
                .bound_unit = "of the brightest neighbour's radiance"};
    }
    return {.on = true, .reason = "light scatters in skin that is on the screen, farther than a pixel"};
}

ScatterInput input_of(CharacterState& state, const FrameGraph& graph) {
    ScatterInput input;
    const View& view = *state.view;
    input.light = graph[state.resources.skin_light].handle;
    input.albedo = graph[state.resources.skin_albedo].handle;
    input.depth = graph[state.resources.skin_depth].handle;
    input.width = view.width;
    input.height = view.height;
    input.projection = scatter_projection(view, state.millimetres_a_unit);
    input.follow_mm = scatter_follow_mm(state);
    return input;
}

void copy(const ScatterInput& input, GLuint from, GLuint to) {
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0,
                       static_cast<GLsizei>(input.width), static_cast<GLsizei>(input.height), 1);
}

void scatter(CharacterState& state, const FrameGraph& graph) {
    auto& own = state.own<State>();
    const ScatterInput input = input_of(state, graph);
    const auto& wanted = state.own<ScatterCapture>();
    if (wanted.light != 0) {
        copy(input, input.light, wanted.light);
        copy(input, input.albedo, wanted.albedo);
        copy(input, input.depth, wanted.depth);
    }
    const GLuint scene = graph[own.scene].handle;
    const auto handle = [&graph](ResourceId id) { return graph[id].handle; };
    switch (method_of(state)) {
        case ScatterMethod::separable: {
            const KernelShape shape = scatter_kernel_shape(state);
            const std::uint32_t samples = 9U + 8U * state.settings.choice("scattering", "samples");
            const std::uint8_t kernel = state.settings.choice("scattering", "kernel");
            const std::uint8_t material = state.settings.choice("scattering", "material");
            if (!(own.shape == shape) || own.kernel != kernel || own.material != material ||
                own.taps.size() != samples) {
                own.shape = shape;
                own.kernel = kernel;
                own.material = material;
                own.taps = is_fitted(state)
                               ? separable_kernel(shape, samples)
                               : preintegrated_kernel(scatter_profile(state), relative_width(state), samples);
            }
            own.passes.separable(input, own.taps, {.first = handle(own.first), .stencil = handle(own.stencil)}, scene);
            break;
        }
        case ScatterMethod::gaussians4:
        case ScatterMethod::gaussians6: {
            const bool four = method_of(state) == ScatterMethod::gaussians4 && of_skin(state);
            const ScatterScratch scratch{handle(own.first), handle(own.second), handle(own.third), 0};
            own.passes.gaussians(input, four ? skin_four_gaussians() : scatter_profile(state), scratch, scene);
            break;
        }
        case ScatterMethod::jittered:
            if (own.jittered.wide.radius_mm == 0 ||
                own.jittered_material != state.settings.choice("scattering", "material")) {
                own.jittered_material = state.settings.choice("scattering", "material");
                own.jittered = jittered_kernel(scatter_profile(state));
            }
            own.passes.jittered(input, own.jittered, scene);
            break;
        case ScatterMethod::off:
            break;
    }
}

void declare(CharacterState& state) {
    auto& own = state.own<State>();
    const TextureShape half{PixelFormat::rgba16f, state.view->width, state.view->height, 1};
    TextureShape stencil = half;
    stencil.format = PixelFormat::stencil8;
    const ScatterMethod method = method_of(state);
    own.scene = state.resources.scene_color;
    state.graph.pass("scatter", [&state](const FrameGraph& graph) { scatter(state, graph); })
        .reads(state.resources.skin_light)
        .reads(state.resources.skin_albedo)
        .reads(state.resources.skin_depth);
    if (method != ScatterMethod::jittered) {
        own.first = state.graph.texture("scattered light", half);
        state.graph.writes(own.first);
    }
    if (method == ScatterMethod::separable) {
        own.stencil = state.graph.texture("skin stencil", stencil);
        state.graph.writes(own.stencil);
    }
    if (method == ScatterMethod::gaussians4 || method == ScatterMethod::gaussians6) {
        own.second = state.graph.texture("scattered light, second", half);
        own.third = state.graph.texture("scattered light, sum", half);
        state.graph.writes(own.second).writes(own.third);
    }
    state.graph.modifies(state.resources.scene_color);
}

constexpr std::array<HardCase, 6> hard_cases = {{
    {"a face a kilometre away", "left out: smaller than the kernel", [](Face&) {}, 0,
     [](View& view) { view.camera.view_from_world[3].z -= 1e3F; }},
    {"a camera inside the skin", "taps end somewhere, and all stays finite", [](Face&) {}, 0,
     [](View& view) { view.camera.view_from_world = glm::mat4(1); }},
    {"a field of view of one degree", "a kernel wider than the frame ends somewhere", [](Face&) {}, 0,
     [](View& view) {
         view.camera.clip_from_view[0][0] = 114.6F;
         view.camera.clip_from_view[1][1] = 114.6F;
     }},
    {"a field of view of 170 degrees", "a small face, drawn or left out", [](Face&) {}, 0,
     [](View& view) {
         view.camera.clip_from_view[0][0] = 0.0875F;
         view.camera.clip_from_view[1][1] = 0.0875F;
     }},
    {"an orthographic camera", "one size everywhere", [](Face&) {}, 0,
     [](View& view) {
         glm::mat4 clip(1);
         clip[2][2] = -0.01F;
         view.camera.clip_from_view = clip;
     }},
    {"a frame of one pixel", "nothing to gather from", [](Face&) {}, 0,
     [](View& view) { view.width = view.height = 1; }},
}};

}  // namespace

std::span<const GaussianTerm> scatter_profile(const CharacterState& state) {
    const std::uint8_t material = state.settings.choice(scattering_effect.name, "material");
    if (material == 0) return skin_six_gaussians();
    static std::array<std::vector<GaussianTerm>, material_choices.size()> fitted = [] {
        std::array<std::vector<GaussianTerm>, material_choices.size()> made;
        const auto materials = measured_materials();
        for (std::size_t m = 0; m < materials.size(); ++m) {
            assert(materials[m].name == material_choices[m + 1]);
            made[m + 1] = gaussians_of(materials[m]);
        }
        return made;
    }();
    return fitted[material];
}

KernelShape scatter_kernel_shape(const CharacterState& state) {
    return {number(state, "width"),
            {number(state, "strength_red"), number(state, "strength_green"), number(state, "strength_blue")},
            {number(state, "falloff_red"), number(state, "falloff_green"), number(state, "falloff_blue")}};
}

double scatter_follow_mm(const CharacterState& state) {
    // Listing 6 fades a tap out at 300 * 1 / tan(fov / 2) * width of depth: for 20 degrees and a width of 0.014 at 42
    // thousandths of a head, 10 mm, three times the kernel's range.
    const bool follows = state.settings.choice("scattering", "follow_surface") == 0;
    return follows ? 3 * kernel_range_mm(scatter_kernel_shape(state)) : 0;
}

ScatterProjection scatter_projection(const View& view, double millimetres_a_unit) {
    const glm::mat4& clip = view.camera.clip_from_view;
    ScatterProjection projection;
    projection.perspective = clip[2][3] != 0 ? 1 : 0;
    const double unit = projection.perspective != 0 ? 1 : 1 / millimetres_a_unit;
    const auto pixels = [unit](float scale, std::uint32_t side) {
        const double value = std::abs(static_cast<double>(scale)) * 0.5 * side * unit;
        return std::isfinite(value) ? value : 0;
    };
    projection.scale = {pixels(clip[0][0], view.width), pixels(clip[1][1], view.height)};
    return projection;
}

const Effect scattering_effect = {
    .name = "scattering",
    .what = "light spreads in skin",
    .settings = settings,
    .stage = Stage::scene,
    .need = need,
    .declare = declare,
    .studies = scattering_studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
