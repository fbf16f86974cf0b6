// USC ICT-FaceKit: Li et al. 2020, "Learning Formation of Physically-Based Face Attributes", CVPR; the layout is that
// of the folder FaceXModel of its public repository.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "runtime/files/image_file.h"
#include "runtime/files/import/file_tree.h"
#include "runtime/files/import/head_assembler.h"
#include "runtime/files/import/import_result.h"
#include "runtime/files/obj/polygons.h"

namespace blush::load {
namespace {

constexpr std::string_view neutral_name = "generic_neutral_mesh.obj";
constexpr float metres_from_centimetres = 0.01F;
// The spacing of floats between 8 and 16 (centimetres, the size of a head) is 9.5e-7: what is smaller is lost when a
// runtime adds it.
constexpr double least_delta_centimetres = 1e-6;

/// "eyeBlink_L" is "eyeBlinkLeft", "PupilDilate_R" is "pupilDilateRight".
std::string arkit_name(std::string_view file) {
    std::string name(file.substr(0, file.rfind('.')));
    if (name.empty()) return name;
    if (name.front() >= 'A' && name.front() <= 'Z') name.front() = static_cast<char>(name.front() - 'A' + 'a');
    const auto replace_end = [&](std::string_view mark, std::string_view side) {
        if (name.ends_with(mark)) name.replace(name.size() - mark.size(), mark.size(), side);
    };
    replace_end("_L", "Left");
    replace_end("_R", "Right");
    return name;
}

struct IctFiles {
    std::optional<Polygons> neutral;
    std::uint64_t neutral_faces = 0;
    std::map<std::string, ObjPositions> expressions;  ///< by file name: sorted, whatever the archive's order
    std::size_t identities = 0;
};

IctFiles read_files(const std::filesystem::path& path) {
    IctFiles files;
    const auto wanted = [&](std::string_view name) {
        const std::string_view file = file_name(name);
        if (!file.ends_with(".obj")) return false;
        if (!file.starts_with("identity")) return true;
        ++files.identities;
        return false;
    };
    each_file(path, wanted, [&](const std::string& name, const Bytes& bytes) {
        const std::string file(file_name(name));
        if (file == neutral_name) {
            if (files.neutral) refuse(name, "the neutral head is in it twice");
            files.neutral = read_polygons(bytes, PartsBy::material, name);
            files.neutral_faces = read_positions(bytes, name).faces_hash;
        } else if (!files.expressions.try_emplace(file, read_positions(bytes, name)).second) {
            refuse(name, "the expression is in it twice");
        }
    });
    if (!files.neutral)
        refuse("", "there is no " + std::string(neutral_name) + " in it, the neutral head of ICT-FaceKit");
    const std::size_t vertices = files.neutral->positions.size();
    for (const auto& [name, expression] : files.expressions) {
        if (expression.positions.size() != vertices) {
            refuse(name, "it has " + std::to_string(expression.positions.size()) + " vertices, the neutral head has " +
                             std::to_string(vertices));
        }
        if (expression.faces_hash != files.neutral_faces) refuse(name, "its faces are not those of the neutral head");
    }
    return files;
}

// --- Materials -------------------------------------------------------------------------------------------------------

// The eyes' texture coordinates are discs about (0.5, 0.5). On the outer shell (M_Sclera) the ring of corners at 0.139
// is the last that bulges: inside it the shell is the cornea. On the inner one (M_Iris) the pupil's rim lies at 0.09
// and the iris ends at 0.44; the corners of the square hold the back, which nobody sees.
constexpr float cornea_radius_uv = 0.15F;
constexpr double pupil_radius_uv = 0.095, iris_radius_uv = 0.44;

float from_centre(glm::vec2 uv) { return glm::distance(uv, glm::vec2(0.5F)); }

/// A number from 0 to 1 that only depends on its argument (Jarzynski and Olano 2020, the PCG hash).
double hashed(std::uint32_t n) {
    std::uint32_t state = n * 747796405U + 2891336453U;
    state = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return static_cast<double>((state >> 22U) ^ state) / 4294967295.0;
}

/// Fibres around the pupil at the angle `turns` (1: all the way round): smooth noise that closes.
double fibres(double turns, std::uint32_t count, std::uint32_t seed) {
    const double at = (turns - std::floor(turns)) * count;
    const auto low = static_cast<std::uint32_t>(at);
    const double t = at - low, s = t * t * (3 - 2 * t);
    return (1 - s) * hashed(seed + low % count) + s * hashed(seed + (low + 1) % count);
}

/// sRGB: a brown iris in the layout above, lighter around the pupil, with a dark ring at its border.
PackedImage iris_image() {
    constexpr std::uint32_t side = 512;
    Bytes pixels;
    pixels.reserve(std::size_t{3} * side * side);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const glm::dvec2 d = (glm::dvec2(x, y) + 0.5) / static_cast<double>(side) - 0.5;
            const double r = (glm::length(d) - pupil_radius_uv) / (iris_radius_uv - pupil_radius_uv);
            const double turns = std::atan2(d.y, d.x) / 6.283185307179586 + 0.02 * std::sin(9 * r);
            const double fibre = 0.65 * fibres(turns, 160, 1) + 0.35 * fibres(turns, 47, 1000);
            const double around_pupil = std::exp(-8 * std::max(r, 0.0) * std::max(r, 0.0));
            const double border = 1 - 0.8 * glm::smoothstep(0.78, 1.0, r);
            const glm::dvec3 brown(86, 56, 34), amber(148, 98, 48);
            glm::dvec3 color = glm::mix(brown, amber, around_pupil) * (0.65 + 0.6 * fibre) * border;
            color *= glm::smoothstep(-0.02, 0.04, r) * (1 - glm::smoothstep(1.0, 1.04, r));
            for (glm::length_t c = 0; c < 3; ++c)
                pixels.push_back(static_cast<std::uint8_t>(std::min(color[c], 255.0)));
        }
    }
    return {"iris", "image/png", encode_png(side, side, 3, pixels)};
}

/// Black, with the strands of the lash cards in alpha. Each of six cards is a band of v, 0.14 high, the root at its
/// greater v (OBJ's, growing upward); the cards of both eyes share the bands, one a half of u.
PackedImage lash_image() {
    constexpr std::uint32_t side = 1024;
    struct Card {
        double root_v;
        std::uint32_t strands;
        double length;
    };
    // Upper lashes number about three times the lower ones and are twice as long (Na et al. 2006).
    constexpr Card cards[] = {{0.988, 44, 1},    {0.822, 44, 0.95}, {0.656, 44, 0.9},
                              {0.486, 20, 0.55}, {0.320, 20, 0.5},  {0.154, 20, 0.45}};
    constexpr double card_height = 0.14;
    Bytes pixels(std::size_t{4} * side * side, 0);
    for (std::uint32_t y = 0; y < side; ++y) {
        const double v = 1 - (y + 0.5) / side;
        const auto card =
            std::ranges::find_if(cards, [&](const Card& c) { return v <= c.root_v && v > c.root_v - card_height; });
        if (card == std::end(cards)) continue;
        const double along = (card->root_v - v) / card_height;
        const auto number = static_cast<std::uint32_t>(card - std::begin(cards));
        for (std::uint32_t x = 0; x < side; ++x) {
            const double u = (x + 0.5) / side, across = (u - std::floor(2 * u) / 2) * 2;
            double alpha = 0;
            // A strand leans, so that it may come from a neighbouring cell.
            const double cell = across * card->strands;
            for (int step = -2; step <= 2; ++step) {
                const double index = std::floor(cell) + step;
                if (index < 0 || index >= card->strands) continue;
                const std::uint32_t seed =
                    977 * number + 7919 * static_cast<std::uint32_t>(2 * u) + static_cast<std::uint32_t>(index);
                const double length = card->length * (0.7 + 0.3 * hashed(seed));
                if (along > length) continue;
                const double t = along / length;
                const double lean = 1.6 * (hashed(seed + 31337) - 0.5) * t * t;
                const double from_axis = std::abs(cell - (index + 0.3 + 0.4 * hashed(seed + 4242) + lean));
                const double half_width = 0.02 + 0.16 * (1 - t);
                alpha = std::max(alpha, 1 - glm::smoothstep(0.6, 1.4, from_axis / half_width));
            }
            pixels[4 * (std::size_t{y} * side + x) + 3] = static_cast<std::uint8_t>(alpha * 255);
        }
    }
    return {"lashes", "image/png", encode_png(side, side, 4, pixels)};
}

struct Look {
    std::string_view source;  ///< usemtl
    std::string_view material, mesh;
    glm::vec4 base_color_linear;
    float roughness;
    bool see_through = false;
};

// Colours: light skin after the chart values of von Luschan's mid-lights; teeth and gums as in the default face.
constexpr Look looks[] = {
    {"M_Face", "skin", "head", {0.58F, 0.36F, 0.27F, 1}, 0.45F},
    {"M_BackHead", "skinBack", "head", {0.58F, 0.36F, 0.27F, 1}, 0.5F},
    {"M_GumsTongue", "gums", "mouth", {0.28F, 0.075F, 0.07F, 1}, 0.35F},
    {"M_Teeth", "teeth", "mouth", {0.76F, 0.69F, 0.58F, 1}, 0.25F},
    {"M_ScleraLeft", "sclera", "eyeballLeft", {0.72F, 0.68F, 0.64F, 1}, 0.15F},
    {"M_IrisLeft", "iris", "eyeballLeft", {1, 1, 1, 1}, 0.4F},
    {"M_ScleraRight", "sclera", "eyeballRight", {0.72F, 0.68F, 0.64F, 1}, 0.15F},
    {"M_IrisRight", "iris", "eyeballRight", {1, 1, 1, 1}, 0.4F},
    // The fluid along the lower lid and in the inner corner: nearly clear and wet.
    {"M_LacrimalFluid", "tears", "eyeRims", {0.9F, 0.85F, 0.82F, 0.12F}, 0.08F, true},
    // Shells over the eye that soften its border to the lids.
    {"M_EyeBlend", "eyeBlend", "eyeRims", {0.30F, 0.12F, 0.10F, 0.25F}, 0.5F, true},
    {"M_EyeOcclusion", "eyeOcclusion", "eyeRims", {0.03F, 0.012F, 0.01F, 0.3F}, 0.8F, true},
    {"M_EyeLashes", "lashes", "lashes", {1, 1, 1, 1}, 0.9F, true},
};

std::int32_t add_material(const Look& look, Face& face) {
    const auto same = std::ranges::find(face.materials, look.material, &Material::name);
    if (same != face.materials.end()) return static_cast<std::int32_t>(same - face.materials.begin());
    Material& material = face.materials.emplace_back();
    material.name = look.material;
    material.metallic = 0;
    material.roughness = look.roughness;
    material.base_color_linear = look.base_color_linear;
    if (look.see_through) material.alpha_mode = AlphaMode::blend;
    if (look.material == "iris") material.base_color_srgb.image = 0;
    if (look.material == "lashes") {
        material.double_sided = true;
        material.base_color_srgb.image = 1;
    }
    return static_cast<std::int32_t>(face.materials.size() - 1);
}

constexpr Look cornea_look{"", "cornea", "", {0.02F, 0.02F, 0.02F, 0.1F}, 0.05F, true};

void add_meshes(const Surface& surface, HeadAssembler& head, std::vector<std::string>& notes) {
    const Polygons& polygons = surface.polygons();
    const auto part_of = [&](const Polygons::Polygon& p) -> std::string_view { return polygons.parts[p.part]; };
    std::vector<std::pair<std::string_view, std::vector<Piece>>> meshes;
    const auto pieces_of = [&](std::string_view mesh) -> std::vector<Piece>& {
        auto found = std::ranges::find(meshes, mesh, &decltype(meshes)::value_type::first);
        return found != meshes.end() ? found->second : meshes.emplace_back(mesh, std::vector<Piece>()).second;
    };
    for (const Look& look : looks) {
        const auto is_cornea = [&](const Polygons::Polygon& polygon) {
            return look.material == "sclera" && all_corners(polygons, polygon, [&](Polygons::Corner c) {
                       return c.uv != Polygons::no_uv && from_centre(polygons.uv[c.uv]) < cornea_radius_uv;
                   });
        };
        const auto is_opaque = [&](const auto& p) { return part_of(p) == look.source && !is_cornea(p); };
        const auto is_clear = [&](const auto& p) { return part_of(p) == look.source && is_cornea(p); };
        std::vector<Piece>& pieces = pieces_of(look.mesh);
        pieces.push_back({add_material(look, head.face), polygons_where(polygons, is_opaque)});
        if (look.material == "sclera")
            pieces.push_back({add_material(cornea_look, head.face), polygons_where(polygons, is_clear)});
    }
    const auto is_known = [&](std::string_view part) {
        return std::ranges::find(looks, part, &Look::source) != std::end(looks);
    };
    for (std::uint32_t part = 0; part < polygons.parts.size(); ++part) {
        if (is_known(polygons.parts[part])) continue;
        auto strange = polygons_where(polygons, [&](const auto& p) { return p.part == part; });
        if (strange.empty()) continue;
        notes.push_back("the material \"" + polygons.parts[part] + "\" is not ICT-FaceKit's and stays without a look");
        pieces_of("others").push_back({-1, std::move(strange)});
    }
    for (const auto& [name, pieces] : meshes) head.add_mesh(std::string(name), surface, pieces, 0);
}

}  // namespace
}  // namespace blush::load

namespace blush {

Result<ImportedHead> import_ict(const std::filesystem::path& folder_or_archive) {
    using namespace load;
    return guarded(folder_or_archive, [&]() -> Result<ImportedHead> {
        IctFiles files = read_files(folder_or_archive);
        std::vector<std::string> names, notes;
        std::vector<std::vector<glm::dvec3>> targets;
        for (auto& [name, expression] : files.expressions) {
            names.push_back(arkit_name(name));
            targets.push_back(std::move(expression.positions));
        }
        if (files.identities > 0)
            notes.push_back(std::to_string(files.identities) +
                            " identity shapes are left out: the head is the neutral one");
        if (names.empty()) notes.emplace_back("there are no expressions in it: the head does not move");

        const Surface surface(std::move(*files.neutral), std::move(targets));
        HeadAssembler head(names, least_delta_centimetres);
        Node& root = head.face.nodes.emplace_back();
        root.name = "ictFaceKit";
        root.rest.scale = glm::vec3(metres_from_centimetres);
        add_meshes(surface, head, notes);
        const PackedImage images[] = {iris_image(), lash_image()};
        return write_head(std::move(head.face), images, std::move(notes));
    });
}

}  // namespace blush
