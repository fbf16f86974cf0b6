/// Subsurface scattering in screen space: the separable kernel of jimenez-2012, chapter 6, and its slower twins.

#include <algorithm>
#include <array>
#include <cassert>

#include "rig/light/separable_kernel.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/scattering.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/scatter_projection.h"

namespace blush::shared {
#include "shaders/light/scattering_uniforms.glsl"
}  // namespace blush::shared

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
     material_choices, 0, 0, 0, 0, SettingOwner::character},
    {"follow_surface", "on: light does not cross steps of depth; off: it does", follow_choices, 0},
    {"width", "how far light goes; 1: as the measured profile has it", {}, 0, 0.01, 10, 1.12, SettingOwner::character},
    {"strength_red",
     "share of red light that enters; of the fitted kernel",
     {},
     0,
     0,
     1,
     0.969,
     SettingOwner::character},
    {"strength_green", "share of green light that enters", {}, 0, 0, 1, 1, SettingOwner::character},
    {"strength_blue", "share of blue light that enters", {}, 0, 0, 1, 1, SettingOwner::character},
    {"falloff_red", "reach of red, as a factor on the red profile", {}, 0, 0.01, 1, 0.58, SettingOwner::character},
    {"falloff_green", "reach of green, as a factor on the red profile", {}, 0, 0.01, 1, 0.267, SettingOwner::character},
    {"falloff_blue", "reach of blue, as a factor on the red profile", {}, 0, 0.01, 1, 0.215, SettingOwner::character},
    {"albedo_before",
     "share of the albedo that light meets before it scatters, as an exponent; 0: sharpest, 1: softest",
     {},
     0,
     0,
     1,
     0.5,
     SettingOwner::character},
    {"millimetres_a_unit", "scale of the face; 0: found from its size", {}, 0, 0, 1e6, 0, SettingOwner::character},
}};
using Own = OwnSetting<scattering_effect, settings>;

/// What decides a character's kernel.
struct Profile {
    KernelShape shape;
    std::uint8_t material = 0;

    bool operator==(const Profile&) const = default;
};

struct State {
    ScatterPasses passes;
    ScatterTable table;
    std::vector<Profile> profiles;             // of the characters whose skin is on the screen, each once
    std::vector<const CharacterState*> first;  // a character of each profile
    std::vector<ScatterCharacter> characters;
    std::uint8_t kernel = 0;
    std::uint32_t samples = 0;
    std::vector<Profile> kernel_profiles;  // that `kernels` are of
    std::vector<std::vector<KernelTap>> kernels;
    std::vector<Profile> jittered_profiles;
    std::vector<JitteredKernel> jittered;
    ResourceId first_image{}, second{}, third{}, stencil{}, scene{};
};

double number(const CharacterState& character, Own setting) { return character.settings.number(setting); }

ScatterMethod method_of(const FrameState& frame) {
    return static_cast<ScatterMethod>(frame.settings.choice(Own("method")));
}

bool of_skin(const CharacterState& character) { return character.settings.choice(Own("material")) == 0; }

/// Eq. 6.1 is a fit to skin: what else light scatters in has its profile's integral.
bool is_fitted(const FrameState& frame, const CharacterState& character) {
    return of_skin(character) && frame.settings.choice(Own("kernel")) == 1;
}

/// The width that the settings ask for, 1 for the profile's own millimetres.
double relative_width(const CharacterState& character) {
    return number(character, "width") / skin_kernel_shape().width;
}

/// As far as the farthest tap.
double scatter_range_mm(const FrameState& frame, const CharacterState& character) {
    if (is_fitted(frame, character)) return kernel_range_mm(scatter_kernel_shape(character));
    return 3 * relative_width(character) * std::sqrt(scatter_profile(character).back().variance_mm2);
}

Need need(const FrameState& frame) {
    const auto none_has = [&frame](auto has) { return std::ranges::none_of(frame.characters, has); };
    if (none_has([](const CharacterState* character) { return !character->facts_of_face.skin.parts.empty(); })) {
        return {.on = false, .reason = "the face has no skin", .can_be_forced = false};
    }
    if (method_of(frame) == ScatterMethod::off) {
        return {.on = false, .reason = "scattering.method is off", .can_be_forced = false};
    }
    if (!frame.facts.skin_on_screen) return {.on = false, .reason = "no skin is on the screen"};
    if (frame.lights.empty() && frame.lighting->environment == nullptr &&
        frame.lighting->sky_radiance_linear == glm::vec3(0) && frame.lighting->ground_radiance_linear == glm::vec3(0)) {
        return {.on = false, .reason = "no light falls on the skin"};
    }
    if (none_has([&frame](const CharacterState* character) {
            return scatter_range_mm(frame, *character) * character->skin.pixels_a_mm >= 0.5;
        })) {
        // Every tap lies within the pixel. The bound: 0.1 of radiance, where a hard edge of light passes through it.
        return {.on = false,
                .reason = "the kernel ends within half a pixel of its centre",
                .omission = Omission::bounded,
                .bound = 0.1,
                .bound_unit = "of the brightest neighbour's radiance"};
    }
    return {.on = true, .reason = "light scatters in skin that is on the screen, farther than a pixel"};
}

/// The characters whose skin is on the screen, and their profiles, each once.
void list_characters(FrameState& frame, State& own) {
    own.profiles.clear();
    own.first.clear();
    own.characters.clear();
    const double unit = frame.clip_from_view[2][3] != 0 ? 0 : 1;  // orthographic: a millimetre is one size everywhere
    double reference_mm_a_unit = 0;
    for (const CharacterState* character : frame.characters) {
        if (!character->skin.on_screen) continue;
        const Profile profile{scatter_kernel_shape(*character), character->settings.choice(Own("material"))};
        const auto found = std::ranges::find(own.profiles, profile);
        const auto index = static_cast<std::uint32_t>(found - own.profiles.begin());
        if (found == own.profiles.end()) {
            own.profiles.push_back(profile);
            own.first.push_back(character);
        }
        if (reference_mm_a_unit == 0) reference_mm_a_unit = character->millimetres_a_unit;
        const double scale = unit == 0 ? 1 : reference_mm_a_unit / character->millimetres_a_unit;
        own.characters.push_back({character->index + 1, index, scatter_follow_mm(frame, *character), scale});
    }
}

std::uint32_t samples_of(const FrameState& frame) { return 9U + 8U * frame.settings.choice(Own("samples")); }

const std::vector<std::vector<KernelTap>>& separable_kernels(FrameState& frame, State& own) {
    const std::uint32_t samples = samples_of(frame);
    const std::uint8_t kernel = frame.settings.choice(Own("kernel"));
    if (own.samples == samples && own.kernel == kernel && own.kernel_profiles == own.profiles) return own.kernels;
    own.samples = samples;
    own.kernel = kernel;
    own.kernel_profiles = own.profiles;
    own.kernels.clear();
    for (std::size_t p = 0; p < own.profiles.size(); ++p) {
        const CharacterState& character = *own.first[p];
        own.kernels.push_back(is_fitted(frame, character) ? separable_kernel(own.profiles[p].shape, samples)
                                                          : preintegrated_kernel(scatter_profile(character),
                                                                                 relative_width(character), samples));
    }
    return own.kernels;
}

const std::vector<JitteredKernel>& jittered_kernels(State& own) {
    if (own.jittered_profiles == own.profiles) return own.jittered;
    own.jittered_profiles = own.profiles;
    own.jittered.clear();
    for (const CharacterState* character : own.first) {
        own.jittered.push_back(jittered_kernel(scatter_profile(*character)));
    }
    return own.jittered;
}

ScatterInput input_of(FrameState& frame, const State& own, const FrameGraph& graph) {
    ScatterInput input;
    input.light = graph[frame.target(scattering_effect, 0)].handle;
    input.albedo = graph[frame.target(scattering_effect, 1)].handle;
    input.depth = graph[frame.target(scattering_effect, 2)].handle;
    input.width = frame.view->width;
    input.height = frame.view->height;
    if (own.characters.empty()) return input;  // forced on
    const CharacterState& first = *own.first[0];
    input.projection = scatter_projection(frame, first.millimetres_a_unit);
    input.follow_mm = scatter_follow_mm(frame, first);
    return input;
}

void copy(const ScatterInput& input, GLuint from, GLuint to) {
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0,
                       static_cast<GLsizei>(input.width), static_cast<GLsizei>(input.height), 1);
}

void scatter(FrameState& frame, const FrameGraph& graph) {
    auto& own = frame.own<State>();
    list_characters(frame, own);
    ScatterInput input = input_of(frame, own, graph);
    const auto& wanted = frame.own<ScatterCapture>();
    if (wanted.light != 0) {
        copy(input, input.light, wanted.light);
        copy(input, input.albedo, wanted.albedo);
        copy(input, input.depth, wanted.depth);
    }
    if (own.characters.empty()) return;
    const bool many = own.characters.size() > 1;
    const GLuint scene = graph[own.scene].handle;
    const auto handle = [&graph](ResourceId id) { return graph[id].handle; };
    const ScatterMethod method = method_of(frame);
    if (method == ScatterMethod::separable) {
        const std::vector<std::vector<KernelTap>>& kernels = separable_kernels(frame, own);
        if (many) {
            own.table.write(own.characters, kernels);
            input.table = &own.table.buffer();
        }
        own.passes.separable(input, kernels[0], {.first = handle(own.first_image), .stencil = handle(own.stencil)},
                             scene);
        return;
    }
    // The slower twins take one profile after the other.
    if (many) {
        own.table.write(own.characters, {});
        input.table = &own.table.buffer();
    }
    for (std::size_t p = 0; p < own.profiles.size(); ++p) {
        input.only_profile = many ? static_cast<std::int32_t>(p) : -1;
        const CharacterState& character = *own.first[p];
        if (method == ScatterMethod::jittered) {
            own.passes.jittered(input, jittered_kernels(own)[p], scene);
            continue;
        }
        const bool four = method == ScatterMethod::gaussians4 && of_skin(character);
        const ScatterScratch scratch{handle(own.first_image), handle(own.second), handle(own.third), 0};
        own.passes.gaussians(input, four ? skin_four_gaussians() : scatter_profile(character), scratch, scene);
    }
}

void declare(FrameState& frame) {
    auto& own = frame.own<State>();
    const TextureShape half{PixelFormat::rgba16f, frame.view->width, frame.view->height, 1};
    TextureShape stencil = half;
    stencil.format = PixelFormat::stencil8;
    const ScatterMethod method = method_of(frame);
    own.scene = frame.resources.scene_color;
    // One character of a scene may come to be seen alone, or with others.
    own.passes.require(method, samples_of(frame), false);
    if (frame.characters.size() > 1) own.passes.require(method, samples_of(frame), true);
    frame.graph.pass("scatter", [&frame](const FrameGraph& graph) { scatter(frame, graph); })
        .reads(frame.target(scattering_effect, 0))
        .reads(frame.target(scattering_effect, 1))
        .reads(frame.target(scattering_effect, 2));
    if (method != ScatterMethod::jittered) {
        own.first_image = frame.graph.texture("scattered light", half);
        frame.graph.writes(own.first_image);
    }
    if (method == ScatterMethod::separable) {
        own.stencil = frame.graph.texture("skin stencil", stencil);
        frame.graph.writes(own.stencil);
    }
    if (method == ScatterMethod::gaussians4 || method == ScatterMethod::gaussians6) {
        own.second = frame.graph.texture("scattered light, second", half);
        own.third = frame.graph.texture("scattered light, sum", half);
        frame.graph.writes(own.second).writes(own.third);
    }
    frame.graph.modifies(frame.resources.scene_color);
}

constexpr std::array<HardCase, 6> hard_cases = {{
    {"a face a kilometre away", "left out: smaller than the kernel", [](Face&) {}, 0,
     [](ViewFrame& view) { view.camera.view_from_world[3].z -= 1e3; }},
    {"a camera inside the skin", "taps end somewhere, and all stays finite", [](Face&) {}, 0,
     [](ViewFrame& view) { view.camera.view_from_world = glm::dmat4(1); }},
    {"a field of view of one degree", "a kernel wider than the frame ends somewhere", [](Face&) {}, 0,
     [](ViewFrame& view) {
         view.camera.clip_from_view[0][0] = 114.6F;
         view.camera.clip_from_view[1][1] = 114.6F;
     }},
    {"a field of view of 170 degrees", "a small face, drawn or left out", [](Face&) {}, 0,
     [](ViewFrame& view) {
         view.camera.clip_from_view[0][0] = 0.0875F;
         view.camera.clip_from_view[1][1] = 0.0875F;
     }},
    {"an orthographic camera", "one size everywhere", [](Face&) {}, 0,
     [](ViewFrame& view) {
         glm::mat4 clip(1);
         clip[2][2] = -0.01F;
         view.camera.clip_from_view = clip;
     }},
    {"a frame of one pixel", "nothing to gather from", [](Face&) {}, 0,
     [](ViewFrame& view) { view.width = view.height = 1; }},
}};

void find_facts(FrameState& frame) {
    for (CharacterState* character : frame.characters) {
        const double set = number(*character, "millimetres_a_unit");
        if (set > 0) character->millimetres_a_unit = set / character->scale_of_place;
    }
}

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    static_cast<shared::ScatteringUniforms*>(to)->albedo_before =
        static_cast<float>(number(character, "albedo_before"));
}

constexpr std::array<std::string_view, 1> hooks = {"output"};
constexpr std::array<UniformField, 1> fields = {
    {{"albedo_before", offsetof(shared::ScatteringUniforms, albedo_before)}}};
/// Light that scatters, the albedo that it leaves by, its depth and its character, each times the skin's matte.
constexpr std::array<ShadingTarget, 3> targets = {{{"skin light", "skin light, multisampled"},
                                                   {"skin albedo", "skin albedo, multisampled"},
                                                   {"skin depth", "skin depth, multisampled", PixelFormat::rg32f}}};
constexpr ShadingPart shading = {
    .output_file = "light/skin_targets.glsl",
    .hooks = hooks,
    .uniforms = {"light/scattering_uniforms.glsl", "ScatteringUniforms", sizeof(shared::ScatteringUniforms), fields,
                 write},
    .targets = targets,
};

}  // namespace

std::span<const GaussianTerm> scatter_profile(const CharacterState& character) {
    const std::uint8_t material = character.settings.choice(Own("material"));
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

KernelShape scatter_kernel_shape(const CharacterState& character) {
    return {
        number(character, "width"),
        {number(character, "strength_red"), number(character, "strength_green"), number(character, "strength_blue")},
        {number(character, "falloff_red"), number(character, "falloff_green"), number(character, "falloff_blue")}};
}

double scatter_follow_mm(const FrameState& frame, const CharacterState& character) {
    // Listing 6 fades a tap out at 300 * 1 / tan(fov / 2) * width of depth: for 20 degrees and a width of 0.014 at 42
    // thousandths of a head, 10 mm, three times the kernel's range.
    const bool follows = frame.settings.choice(Own("follow_surface")) == 0;
    return follows ? 3 * kernel_range_mm(scatter_kernel_shape(character)) : 0;
}

const Effect scattering_effect = {
    .name = "scattering",
    .what = "light spreads in skin",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::scene,
    .find_facts = find_facts,
    .need = need,
    .declare = declare,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
