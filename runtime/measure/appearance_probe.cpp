#include "runtime/measure/appearance_probe.h"
#include "runtime/measure/portrait.h"

#include <algorithm>
#include <cmath>

#include "rig/blood/colour_difference.h"
#include "rig/blood/skin_colour_table.h"
#include "runtime/draw/shading.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/state_guard.h"
#include "runtime/measure/errors.h"

namespace blush {
namespace {

/// Bilinear between texel centres; the map repeats, as its texture does.
template <class T>
auto repeated_sample(const Map<T>& map, glm::dvec2 uv) {
    const glm::dvec2 place = uv * glm::dvec2(map.width, map.height) - 0.5;
    const glm::dvec2 low = glm::floor(place), share = place - low;
    const auto at = [&](int dx, int dy) {
        const auto wrap = [](double value, std::uint32_t size) {
            const auto whole = static_cast<std::int64_t>(value) % size;
            return static_cast<std::uint32_t>(whole < 0 ? whole + size : whole);
        };
        return map.at(wrap(low.x + dx, map.width), wrap(low.y + dy, map.height));
    };
    const auto mixed = [](auto a, auto b, double t) {
        if constexpr (std::is_same_v<T, float>) {
            return static_cast<double>(a) * (1 - t) + static_cast<double>(b) * t;
        } else {
            return glm::dvec2(a) * (1 - t) + glm::dvec2(b) * t;
        }
    };
    return mixed(mixed(at(0, 0), at(1, 0), share.x), mixed(at(0, 1), at(1, 1), share.x), share.y);
}

glm::dvec2 uv_of(std::size_t i) {
    return (glm::dvec2(static_cast<double>(i % AppearanceProbe::side), static_cast<double>(i / AppearanceProbe::side)) +
            0.5) /
           static_cast<double>(AppearanceProbe::side);
}

}  // namespace

std::shared_ptr<AppearanceProbe> AppearanceProbe::create(const Device& device, const Face& face) {
    Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(face.path));
    if (!appearance) return nullptr;
    return create(device, face, *std::move(appearance));
}

std::shared_ptr<AppearanceProbe> AppearanceProbe::create(const Device& device, const Face& face,
                                                         FaceAppearance appearance) {
    Result<Portrait> character = Portrait::create(device, face);
    if (!character) return nullptr;
    character->set_appearance(std::move(appearance));
    std::shared_ptr<AppearanceProbe> probe(new AppearanceProbe(*std::move(character)));
    make_common_passes(probe->character_.frame());
    probe->target_ = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(probe->target_.name(), 1, GL_RGBA32F, side, side);
    probe->framebuffer_ = gl::make_framebuffer();
    glNamedFramebufferTexture(probe->framebuffer_.name(), GL_COLOR_ATTACHMENT0, probe->target_.name(), 0);
    return probe;
}

void AppearanceProbe::draw(std::string_view effect) {
    const ShadingLayout& layout = shading_layout(character_.frame().shared);
    CharacterState& shown = state();
    Permutation permutation;
    permutation.model = MaterialKind::skin;
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        if (layout.parts[k].effect->name != effect) continue;
        const ShadingPart& part = *layout.parts[k].effect->shading;
        permutation.shading.parts = 1U << k;
        if (part.variant != nullptr)
            permutation.shading.variants = part.variant(character_.frame(), shown) << layout.parts[k].first_variant;
    }
    shown.shading = permutation.shading;
    const Result<gl::Program> program =
        make_shading_program(character_.frame().shared, permutation, "screen.vert", "measure/appearance_probe.frag");
    if (!program) return;
    write_effects_block(character_.frame(), shown);
    bind_effects(character_.frame(), shown, permutation);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, side, side);
    glUseProgram(program->name());
    glBindVertexArray(character_.frame().common->no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
}

std::vector<glm::vec3> AppearanceProbe::read() const {
    std::vector<glm::vec4> texels(std::size_t{side} * side);
    glGetTextureImage(target_.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(texels.size() * sizeof(glm::vec4)),
                      texels.data());
    // Row 0 of the target is v = 0, which is the top row of a map.
    return {texels.begin(), texels.end()};
}

void AppearanceProbe::draw_normals(float weight) {
    const gl::StateGuard guard;
    std::ranges::fill(state().pose.wrinkles, weight);
    draw("wrinkles");
}

std::vector<glm::vec3> AppearanceProbe::normals(float weight) {
    draw_normals(weight);
    return read();
}

std::vector<glm::dvec3> AppearanceProbe::exact_normals(float weight) {
    const WrinkleSet& set = *state().asset.appearance().wrinkles;
    std::vector<glm::dvec3> result;
    for (std::size_t i = 0; i < std::size_t{side} * side; ++i) {
        const glm::dvec2 uv = set.part.within(uv_of(i));
        const bool shown = set.part.is_whole() || (glm::all(glm::greaterThan(uv, glm::dvec2(0))) &&
                                                   glm::all(glm::lessThan(uv, glm::dvec2(1))));
        double strength = 0;
        for (std::size_t z = 0; shown && z < set.zones.size(); ++z) {
            if (std::ranges::find(state().rig.wrinkle_zones(), set.zones[z]) == state().rig.wrinkle_zones().end())
                continue;
            strength += static_cast<double>(weight) * repeated_sample(set.masks[z], uv);
        }
        result.push_back(glm::normalize(glm::dvec3(repeated_sample(set.derivatives, uv) * strength, 1)));
    }
    return result;
}

Variant::Error AppearanceProbe::normal_error(float weight) {
    return angle_error(normals(weight), exact_normals(weight));
}

Pose AppearanceProbe::pose_of(std::string_view control) {
    std::vector<float> controls(state().rig.control_names().size(), 0);
    if (const std::optional<ControlId> id = state().rig.find(control)) controls[static_cast<std::size_t>(*id)] = 1;
    Pose pose = state().rig.rest_pose();
    state().rig.evaluate(controls, pose);
    return pose;
}

void AppearanceProbe::draw_colors(std::string_view control) {
    const gl::StateGuard guard;
    if (control.empty()) {
        draw("");
        return;
    }
    state().pose = pose_of(control);
    blend_blood(character_.frame(), state());
    draw("blood");
}

std::vector<glm::vec3> AppearanceProbe::colors(std::string_view control) {
    draw_colors(control);
    return read();
}

std::vector<glm::dvec3> AppearanceProbe::exact_colors(std::string_view control) {
    const SkinPigments& pigments = *state().asset.appearance().pigments;
    const Pose pose = pose_of(control);
    const SkinColourTable table;
    const ScalarMap melanin = resized(pigments.maps.melanin, side, side),
                    skin = resized(pigments.maps.skin, side, side),
                    hemoglobin = resized(pigments.maps.hemoglobin, side, side);
    std::vector<float> shares;
    std::vector<HemoglobinChange> changes;
    for (std::size_t m = 0; m < pose.hemoglobin.size(); ++m) {
        const auto found = std::ranges::find(pigments.blood.names, state().rig.hemoglobin_maps()[m]);
        if (pose.hemoglobin[m] == 0 || found == pigments.blood.names.end()) continue;
        shares.push_back(pose.hemoglobin[m]);
        changes.push_back(pigments.blood.changes[static_cast<std::size_t>(found - pigments.blood.names.begin())]);
    }
    const ScalarMap changed = blended_hemoglobin(hemoglobin, skin, shares, changes, pose.hemoglobin_factor);
    std::vector<glm::dvec3> result;
    for (std::size_t i = 0; i < changed.values.size(); ++i) {
        const glm::dvec3 before(table.colour_linear(melanin.values[i], hemoglobin.values[i]));
        const glm::dvec3 after(table.colour_linear(melanin.values[i], changed.values[i]));
        result.push_back(after / glm::max(before, glm::dvec3(1e-4)));
    }
    return result;
}

Variant::Error AppearanceProbe::color_error(std::string_view control, bool flushed) {
    const std::vector<glm::dvec3> exact = exact_colors(control);
    const std::vector<glm::vec3> drawn = flushed ? colors(control) : std::vector<glm::vec3>(exact.size(), glm::vec3(1));
    constexpr glm::dvec3 light_skin_linear(0.52, 0.30, 0.22);  // so that a factor is a colour difference
    Variant::Error error;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const double difference =
            ciede2000_of_srgb_linear(light_skin_linear * glm::dvec3(drawn[i]), light_skin_linear * exact[i]);
        error.mean += difference / static_cast<double>(exact.size());
        error.worst = std::max(error.worst, difference);
    }
    return error;
}

}  // namespace blush
