#include "runtime/measure/appearance_frames.h"
#include "runtime/measure/portrait.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "rig/blood/colour_difference.h"
#include "rig/blood/skin_colour_table.h"
#include "runtime/appearance/appearance_gpu.h"
#include "runtime/appearance/signed_texture.h"
#include "runtime/files/appearance_file.h"
#include "runtime/frame/frame_state.h"
#include "runtime/offscreen.h"

namespace blush {
namespace {

/// Bilinear between texel centres of a map that repeats.
template <class Wide, class T>
Wide repeated(const Map<T>& map, glm::dvec2 uv) {
    const glm::dvec2 place = uv * glm::dvec2(map.width, map.height) - 0.5;
    const glm::dvec2 low = glm::floor(place), share = place - low;
    const auto at = [&](int dx, int dy) {
        const auto wrap = [](double value, std::uint32_t size) {
            const std::int64_t whole = static_cast<std::int64_t>(value) % size;
            return static_cast<std::uint32_t>(whole < 0 ? whole + size : whole);
        };
        return Wide(map.at(wrap(low.x + dx, map.width), wrap(low.y + dy, map.height)));
    };
    const Wide top = at(0, 0) * (1 - share.x) + at(1, 0) * share.x;
    const Wide bottom = at(0, 1) * (1 - share.x) + at(1, 1) * share.x;
    return top * (1 - share.y) + bottom * share.y;
}

bool by_first_coordinates(const TextureUse& use) {
    return use.image < 0 || (use.uv_set == 0 && use.uv_transform == glm::mat3(1) && use.repeat_u && use.repeat_v);
}

/// An image of floats, of which texel(uv) is each texel.
template <class Texel>
std::int32_t add_image(Face& face, std::uint32_t width, std::uint32_t height, Texel texel) {
    Image image{"exact twin", width, height, 4, {}, {}};
    image.floats.reserve(std::size_t{4} * width * height);
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const glm::dvec4 value = texel((glm::dvec2(i % width, i / width) + 0.5) / glm::dvec2(width, height));
        for (glm::length_t c = 0; c < 4; ++c) image.floats.push_back(static_cast<float>(value[c]));
    }
    face.images.push_back(std::move(image));
    return static_cast<std::int32_t>(face.images.size()) - 1;
}

struct Drawn {
    Portrait character;
    Offscreen offscreen;
    ViewFrame view;

    void draw() {
        character.draw(view);
        glFinish();
    }
    std::vector<glm::dvec3> lab() {
        draw();
        const Image image = offscreen.read();
        std::vector<glm::dvec3> result;
        for (std::size_t i = 0; i + 3 < image.bytes.size(); i += 4) {
            const auto linear = [&](std::size_t c) { return linear_from_srgb(image.bytes[i + c] / 255.0); };
            result.push_back(lab_from_srgb_linear({linear(0), linear(1), linear(2)}));
        }
        return result;
    }
};

struct Setup {
    const Device& device;
    double millimetres_a_unit;
    FaceAppearance appearance;
};

std::shared_ptr<Drawn> make_drawn(const Setup& setup, Face face, std::string_view setting, std::string_view value) {
    constexpr std::uint32_t side_pixels = 192;
    Result<Portrait> character = Portrait::create(setup.device, std::move(face));
    Result<Offscreen> offscreen = Offscreen::create(setup.device, side_pixels, side_pixels, Output::display_srgb);
    if (!character || !offscreen) return nullptr;
    character->set_appearance(setup.appearance);
    if (!character->set("scattering.millimetres_a_unit", std::to_string(setup.millimetres_a_unit))) return nullptr;
    if (!character->set(setting, value)) return nullptr;
    if (const auto anger = character->control("anger")) character->set(*anger, 1);
    auto drawn = std::make_shared<Drawn>(Drawn{*std::move(character), *std::move(offscreen), {}});
    drawn->view = drawn->offscreen.view();
    drawn->view.camera = drawn->character.framing(1).camera(1);
    return drawn;
}

std::vector<Study> study_of(const Setup& setup, const Face& face, Drawn& reference, std::string_view what,
                            std::string_view effect,
                            std::span<const std::pair<std::string_view, std::string_view>> variants) {
    auto exact = std::make_shared<std::vector<glm::dvec3>>(reference.lab());
    Study study{"whole frames of anger, 192x192 pixels", std::string(what), "CIEDE2000", {}, exact};
    for (const auto& [setting, value] : variants) {
        const std::string name = std::string(effect) + "." + std::string(setting);
        const std::shared_ptr<Drawn> drawn = make_drawn(setup, face, name, value);
        if (!drawn) return {};
        Variant variant;
        variant.label = name + "=" + std::string(value);
        variant.work = "a frame";
        variant.is_default = study.variants.empty();
        variant.run = [drawn] { drawn->draw(); };
        variant.error = [drawn, exact] {
            const std::vector<glm::dvec3> lab = drawn->lab();
            Variant::Error error;
            for (std::size_t i = 0; i < lab.size(); ++i) {
                const double difference = ciede2000(lab[i], (*exact)[i]);
                error.mean += difference / static_cast<double>(lab.size());
                error.worst = std::max(error.worst, difference);
            }
            return error;
        };
        study.variants.push_back(std::move(variant));
    }
    return {std::move(study)};
}

/// Texels of a side of a twin's texture where the face has none that it could follow.
constexpr std::uint32_t twin_side = 1024;

glm::dvec4 encoded(const glm::dvec3& linear) {
    return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z), 1};
}

/// The face with its skin's textures in floats, colours no finer than twin_side: so that frames and their twins start
/// from the same numbers, and nothing but wrinkles and blood is compared.
Face study_face(const Face& face, const std::vector<bool>& skin_material) {
    Face plain = face;
    for (std::size_t m = 0; m < face.materials.size(); ++m) {
        if (!skin_material[m]) continue;
        const Material& material = face.materials[m];
        if (material.normal.image >= 0) {
            const NormalMap map = normals_of(face.images[static_cast<std::size_t>(material.normal.image)]);
            plain.materials[m].normal.image = add_image(plain, map.width, map.height, [&](glm::dvec2 uv) {
                return glm::dvec4(0.5 + 0.5 * repeated<glm::dvec3>(map, uv), 1);
            });
        }
        if (material.base_color_srgb.image < 0) continue;
        Result<ColourMap> colours =
            colour_map_of(face.images[static_cast<std::size_t>(material.base_color_srgb.image)], face.path);
        if (!colours) continue;
        const std::uint32_t width = std::min(colours->width, twin_side), height = std::min(colours->height, twin_side);
        if (width != colours->width || height != colours->height) *colours = resized(*colours, width, height);
        plain.materials[m].base_color_srgb.image =
            add_image(plain, width, height, [&](glm::dvec2 uv) { return encoded(repeated<glm::dvec3>(*colours, uv)); });
    }
    return plain;
}

}  // namespace

std::optional<Face> face_with_wrinkles(const Face& face, const std::vector<bool>& skin_material, const WrinkleSet& set,
                                       std::span<const float> zone_weights) {
    Face twin = face;
    for (std::size_t m = 0; m < face.materials.size(); ++m) {
        if (!skin_material[m]) continue;
        const Material& material = face.materials[m];
        if (!by_first_coordinates(material.normal)) return std::nullopt;
        const NormalMap base = material.normal.image < 0
                                   ? NormalMap(twin_side, twin_side, glm::vec3(0, 0, 1))
                                   : normals_of(face.images[static_cast<std::size_t>(material.normal.image)]);
        const auto scale = static_cast<double>(material.normal_scale);
        const std::int32_t image = add_image(twin, base.width, base.height, [&](glm::dvec2 uv) {
            const glm::dvec2 fold_uv = set.part.within(uv);
            const bool shown = set.part.is_whole() || (glm::all(glm::greaterThan(fold_uv, glm::dvec2(0))) &&
                                                       glm::all(glm::lessThan(fold_uv, glm::dvec2(1))));
            double strength = 0;
            for (std::size_t z = 0; shown && z < zone_weights.size(); ++z) {
                if (zone_weights[z] != 0)
                    strength += static_cast<double>(zone_weights[z]) * repeated<double>(set.masks[z], fold_uv);
            }
            const glm::dvec3 flat = repeated<glm::dvec3>(base, uv);
            const glm::dvec2 slope = scale * glm::dvec2(flat) / std::max(flat.z, 1e-3) +
                                     strength * repeated<glm::dvec2>(set.derivatives, fold_uv);
            return glm::dvec4(0.5 + 0.5 * glm::normalize(glm::dvec3(slope, 1)), 1);
        });
        twin.materials[m].normal = {.image = image};
        twin.materials[m].normal_scale = 1;
    }
    return twin;
}

std::optional<Face> face_with_blood(const Face& face, const std::vector<bool>& skin_material,
                                    const SkinPigments& pigments, std::span<const std::string> map_names,
                                    std::span<const float> shares, float factor) {
    Face twin = face;
    const SkinColourTable table(192, 192);  // within CIEDE2000 0.002 of the model
    const auto coordinates = [](ScalarMap map, double largest) {
        for (float& value : map.values) value = table_coordinate(value, largest);
        return map;
    };
    const ScalarMap melanin = coordinates(pigments.maps.melanin, largest_melanin),
                    hemoglobin = coordinates(pigments.maps.hemoglobin, largest_hemoglobin);
    const auto cube = [](double x) { return x * x * x; };
    for (std::size_t m = 0; m < face.materials.size(); ++m) {
        if (!skin_material[m]) continue;
        const Material& material = face.materials[m];
        if (!by_first_coordinates(material.base_color_srgb)) return std::nullopt;
        ColourMap base(twin_side, twin_side, glm::vec3(1));
        if (material.base_color_srgb.image >= 0) {
            const Result<ColourMap> read =
                colour_map_of(face.images[static_cast<std::size_t>(material.base_color_srgb.image)], face.path);
            if (!read) return std::nullopt;
            base = *read;
        }
        const std::int32_t image = add_image(twin, base.width, base.height, [&](glm::dvec2 uv) {
            const double v = repeated<double>(hemoglobin, uv), at_rest = largest_hemoglobin * cube(v);
            double scale = 1, offset = 0;
            for (std::size_t i = 0; i < shares.size(); ++i) {
                const auto found = std::ranges::find(pigments.blood.names, map_names[i]);
                if (shares[i] == 0 || found == pigments.blood.names.end()) continue;
                const HemoglobinChange& change =
                    pigments.blood.changes[static_cast<std::size_t>(found - pigments.blood.names.begin())];
                scale += static_cast<double>(shares[i]) * (repeated<double>(change.scale, uv) - 1);
                offset += static_cast<double>(shares[i]) * repeated<double>(change.offset, uv);
            }
            double changed =
                std::clamp(static_cast<double>(factor) * (scale * at_rest + offset), 0.0, largest_hemoglobin);
            changed = at_rest + repeated<double>(pigments.maps.skin, uv) * (changed - at_rest);
            const auto colour = [&](double blood) {
                return glm::dvec3(table.colour_linear_at(
                    {repeated<double>(melanin, uv), static_cast<float>(std::cbrt(blood / largest_hemoglobin))}));
            };
            const glm::dvec3 flushed =
                repeated<glm::dvec3>(base, uv) * colour(changed) / glm::max(colour(at_rest), glm::dvec3(1e-4));
            return encoded(flushed);
        });
        twin.materials[m].base_color_srgb = {.image = image};
    }
    return twin;
}

std::vector<Study> wrinkle_frame_study(const Device& device, const Face& face, double millimetres_a_unit) {
    Result<FaceAppearance> found = load_face_appearance(appearance_folder(face.path));
    if (!found || !found->wrinkles) return {};
    const Setup setup{device, millimetres_a_unit, {std::move(found->wrinkles), std::nullopt}};
    const std::shared_ptr<Drawn> plain = make_drawn(setup, face, "wrinkles.shown", "no");
    if (!plain) return {};
    plain->draw();
    CharacterState& state = plain->character.state();
    std::vector<float> weights(setup.appearance.wrinkles->zones.size());
    zone_weights_of(state, weights);
    const Face start = study_face(face, state.facts_of_face.skin.material);
    const std::optional<Face> twin =
        face_with_wrinkles(start, state.facts_of_face.skin.material, *setup.appearance.wrinkles, weights);
    if (!twin) return {};
    const std::shared_ptr<Drawn> reference = make_drawn(setup, *twin, "wrinkles.shown", "no");
    if (!reference) return {};
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> variants = {{{"storage", "compressed"},
                                                                                        {"storage", "plain"},
                                                                                        {"storage", "half_float"},
                                                                                        {"encoding", "differences"},
                                                                                        {"shown", "no"}}};
    return study_of(setup, start, *reference, "wrinkles added up on the CPU, as the normal map of the frame",
                    "wrinkles", variants);
}

std::vector<Study> blood_frame_study(const Device& device, const Face& face, double millimetres_a_unit) {
    Result<FaceAppearance> found = load_face_appearance(appearance_folder(face.path));
    if (!found || !found->pigments) return {};
    const Setup setup{device, millimetres_a_unit, {std::nullopt, std::move(found->pigments)}};
    const std::shared_ptr<Drawn> plain = make_drawn(setup, face, "blood.shown", "no");
    if (!plain) return {};
    plain->draw();
    const CharacterState& state = plain->character.state();
    const Face start = study_face(face, state.facts_of_face.skin.material);
    const std::optional<Face> twin =
        face_with_blood(start, state.facts_of_face.skin.material, *setup.appearance.pigments,
                        state.rig.hemoglobin_maps(), state.pose.hemoglobin, state.pose.hemoglobin_factor);
    if (!twin) return {};
    const std::shared_ptr<Drawn> reference = make_drawn(setup, *twin, "blood.shown", "no");
    if (!reference) return {};
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> variants = {
        {{"colour", "texture"}, {"colour", "pigments"}, {"table_nodes", "16"}, {"shown", "no"}}};
    return study_of(setup, start, *reference, "blood added up on the CPU, as the colour texture of the frame", "blood",
                    variants);
}

}  // namespace blush
