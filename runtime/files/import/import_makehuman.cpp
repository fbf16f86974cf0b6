// MakeHuman (makehumancommunity.org), base mesh hm08 and the asset packs faceunits01 and visemes02.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "runtime/files/image_file.h"
#include "runtime/files/import/file_tree.h"
#include "runtime/files/import/head_assembler.h"
#include "runtime/files/import/import_result.h"
#include "runtime/files/import/makehuman_files.h"
#include "runtime/files/obj/polygons.h"

namespace blush::load {
namespace {

constexpr float metres_from_decimetres = 0.1F;
// Targets have three decimals; a part that follows them by weights may move less. The spacing of floats at the height
// of the head (7 decimetres) is 4.8e-7: what is smaller is lost when a runtime adds it.
constexpr double least_delta_decimetres = 5e-7;

struct PartFiles {
    std::string_view stem;
    std::string_view image;  ///< without its ending
};
constexpr PartFiles eyes{"high-poly", "brown_eye"}, teeth{"teeth_base", "teeth"},
    tongue{"tongue01", "tongue01_diffuse"}, lashes{"eyelashes01", "eyelashes01"};
constexpr std::string_view skin_image_end = "_diffuse.png", preferred_skin = "young_lightskinned_male_diffuse.png";

struct MakeHumanFiles {
    std::map<std::string, Bytes> by_name;  ///< by the path inside: sorted, whatever the archive's order

    /// The first file of that name, wherever it is; images only when they are PNG files (a checkout without Git LFS has
    /// text in their place).
    const Bytes* find(std::string_view name, std::string* where = nullptr) const {
        for (const auto& [path, bytes] : by_name) {
            if (file_name(path) != name || (name.ends_with(".png") && !is_png(bytes))) continue;
            if (where) *where = path;
            return &bytes;
        }
        return nullptr;
    }

    static bool is_png(ByteView bytes) {
        constexpr std::uint8_t signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
        return bytes.size() > sizeof signature && std::ranges::equal(bytes.first(sizeof signature), signature);
    }
};

std::string_view stem(std::string_view name) { return file_name(name).substr(0, file_name(name).rfind('.')); }

std::string_view folder_name(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? "" : file_name(path.substr(0, slash));
}

/// Expression targets stand in folders of these names; all others change the person.
bool is_expression(std::string_view path) {
    return path.ends_with(".target") && (folder_name(path) == "faceunits" || folder_name(path) == "visemes");
}

struct Shape {
    std::string name;
    double weight = 1;
};

/// "name" or "name=0.8".
Shape parse_shape(const std::string& text) {
    const std::size_t equals = text.find('=');
    Shape shape{text.substr(0, equals), 1};
    if (equals == std::string::npos) return shape;
    const std::string_view number = std::string_view(text).substr(equals + 1);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), shape.weight);
    constexpr double largest = 10;  // MakeHuman's own go to 1
    if (error != std::errc() || end != number.data() + number.size() || !(std::abs(shape.weight) <= largest))
        refuse("", "the weight of the shape \"" + text + "\" is not a number from -10 to 10");
    return shape;
}

MakeHumanFiles read_files(const std::filesystem::path& path, std::span<const Shape> shapes) {
    const auto wanted = [&](std::string_view name) {
        const std::string_view file = file_name(name);
        if (file == "base.obj" || is_expression(name)) return true;
        for (const PartFiles& part : {eyes, teeth, tongue, lashes}) {
            if (stem(file) == part.stem && (file.ends_with(".obj") || file.ends_with(".mhclo"))) return true;
            if (stem(file) == part.image && file.ends_with(".png")) return true;
        }
        if (file.ends_with(skin_image_end)) return true;
        return file.ends_with(".target") &&
               std::ranges::any_of(shapes, [&](const Shape& s) { return s.name == stem(file); });
    };
    MakeHumanFiles files;
    each_file(path, wanted, [&](const std::string& name, Bytes bytes) { files.by_name[name] = std::move(bytes); });
    return files;
}

/// Collects images and materials.
class Looks {
public:
    Looks(const MakeHumanFiles& files, Face& face, std::vector<std::string>& notes)
        : files_(files), face_(face), notes_(notes) {}

    std::int32_t add(const std::string& name, float roughness, glm::vec4 color_without_image,
                     const std::string& image_file) {
        Material& material = face_.materials.emplace_back();
        material.name = name;
        material.metallic = 0;
        material.roughness = roughness;
        if (const Bytes* bytes = files_.find(image_file)) {
            const auto known = std::ranges::find(images, stem(image_file), &PackedImage::name);
            material.base_color_srgb.image = static_cast<std::int32_t>(known - images.begin());
            if (known == images.end()) images.push_back({std::string(stem(image_file)), "image/png", *bytes});
        } else {
            material.base_color_linear = color_without_image;
            notes_.push_back("there is no " + image_file + ": " + name + " is plain");
        }
        return static_cast<std::int32_t>(face_.materials.size() - 1);
    }

    Material& operator[](std::int32_t material) { return face_.materials[static_cast<std::size_t>(material)]; }

    std::vector<PackedImage> images;

private:
    const MakeHumanFiles& files_;
    Face& face_;
    std::vector<std::string>& notes_;
};

/// The middle of the little cube that marks a joint in the base mesh.
glm::dvec3 joint(const Polygons& base, std::string_view name) {
    glm::dvec3 low(1e30), high(-1e30);
    for (const Polygons::Polygon& polygon : base.polygons) {
        if (base.parts[polygon.part] != name) continue;
        for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
            const glm::dvec3& p = base.positions[base.corners[polygon.first_corner + c].vertex];
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    if (!(low.x <= high.x)) refuse("base.obj", "there is no group " + std::string(name) + ", by which the head is cut");
    return 0.5 * (low + high);
}

/// Polygons of the body above a plane that falls from the nape to the collarbones, without the shoulders.
std::vector<std::uint32_t> head_polygons(const Polygons& base) {
    const glm::dvec3 neck = joint(base, "joint-neck"), head = joint(base, "joint-head");
    // Measured in the distance of the two joints: a bust ends 0.28 of it below the root of the neck, lower in front,
    // and 0.92 of it to the sides. Of the planes tried, this one follows the rings of quads with the fewest steps (4).
    const double unit = head.y - neck.y, drop = 0.28 * unit, slope = 0.2, half_width = 0.92 * unit;
    const auto in_bust = [&](Polygons::Corner corner) {
        const glm::dvec3 p = base.positions[corner.vertex] - neck;
        return p.y > -drop - slope * p.z && std::abs(p.x) < half_width + std::max(0.0, p.y);
    };
    const auto body = std::ranges::find(base.parts, "body") - base.parts.begin();
    return polygons_where(base, [&](const Polygons::Polygon& polygon) {
        return polygon.part == static_cast<std::uint32_t>(body) && all_corners(base, polygon, in_bust);
    });
}

using Bodies = std::vector<std::vector<glm::dvec3>>;  ///< the base mesh at each target

/// A part on the base mesh, at rest and at each target that moves it.
std::optional<Surface> attach(const MakeHumanFiles& files, const PartFiles& part, std::span<const glm::dvec3> base,
                              const Bodies& bodies, std::vector<std::string>& notes) {
    std::string obj_path, fitting_path;
    const Bytes* obj = files.find(std::string(part.stem) + ".obj", &obj_path);
    const Bytes* clothes = files.find(std::string(part.stem) + ".mhclo", &fitting_path);
    if (!obj || !clothes) {
        notes.push_back("there is no " + std::string(part.stem) + (obj ? ".mhclo" : ".obj") +
                        ": that part is left out");
        return std::nullopt;
    }
    Polygons polygons = read_polygons(*obj, PartsBy::group, obj_path);
    const Fitting fitting = read_fitting(*clothes, base.size(), fitting_path);
    if (fitting.anchors.size() != polygons.positions.size()) {
        refuse(fitting_path, "it places " + std::to_string(fitting.anchors.size()) + " vertices, " + obj_path +
                                 " has " + std::to_string(polygons.positions.size()));
    }
    const glm::dvec3 growth = fitting.growth(base);
    polygons.positions = fitting.fit(base, growth);
    Bodies moved;
    for (const std::vector<glm::dvec3>& body : bodies) {
        moved.push_back(fitting.fit(body, growth));
        if (moved.back() == polygons.positions) moved.back().clear();
    }
    return Surface(std::move(polygons), std::move(moved));
}

/// True where the texture is more glass than paint over the middle of a polygon: the cornea of the high-poly eyes.
bool is_clear(const Image& image, const Polygons& polygons, const Polygons::Polygon& polygon) {
    if (image.channels != 4 || image.bytes.empty()) return false;
    glm::dvec2 middle(0);
    for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
        const std::uint32_t uv = polygons.corners[polygon.first_corner + c].uv;
        if (uv == Polygons::no_uv) return false;
        middle += glm::dvec2(polygons.uv[uv]) / static_cast<double>(polygon.corner_count);
    }
    const auto texel = [](double x, std::uint32_t side) {
        return static_cast<std::size_t>(std::clamp(x * side, 0.0, static_cast<double>(side - 1)));
    };
    const std::size_t at = texel(middle.y, image.height) * image.width + texel(middle.x, image.width);
    return image.bytes[4 * at + 3] < 128;
}

void add_eyes(const Surface& surface, const MakeHumanFiles& files, Looks& looks, HeadAssembler& head) {
    const std::string file = std::string(eyes.image) + ".png";
    const std::int32_t ball = looks.add("eyes", 0.15F, {0.72F, 0.68F, 0.64F, 1}, file);
    const std::int32_t cornea = looks.add("cornea", 0.05F, {0.02F, 0.02F, 0.02F, 0.1F}, file);
    looks[cornea].alpha_mode = AlphaMode::blend;
    Image image;
    if (const Bytes* bytes = files.find(file)) {
        std::uint64_t budget = 1ULL << 30;
        image = decode_image(*bytes, 16'384, budget, file);
    }
    const Polygons& polygons = surface.polygons();
    for (const bool left : {true, false}) {
        const auto on_side = [&](Polygons::Corner c) { return (polygons.positions[c.vertex].x > 0) == left; };
        const auto of = [&](bool clear) {
            return polygons_where(polygons, [&](const Polygons::Polygon& p) {
                return all_corners(polygons, p, on_side) && is_clear(image, polygons, p) == clear;
            });
        };
        head.add_mesh(left ? "eyeballLeft" : "eyeballRight", surface,
                      std::vector<Piece>{{ball, of(false)}, {cornea, of(true)}}, 0);
    }
}

std::string skin_file(const MakeHumanFiles& files) {
    if (files.find(preferred_skin)) return std::string(preferred_skin);
    for (const auto& [path, bytes] : files.by_name) {
        const bool of_a_part = stem(path) == tongue.image;
        if (path.ends_with(skin_image_end) && !of_a_part && MakeHumanFiles::is_png(bytes))
            return std::string(file_name(path));
    }
    return std::string(preferred_skin);
}

Result<ImportedHead> import_files(const MakeHumanFiles& files, std::span<const Shape> shapes) {
    std::string base_path;
    const Bytes* base_obj = files.find("base.obj", &base_path);
    if (!base_obj) refuse("", "there is no base.obj in it, MakeHuman's base mesh");
    Polygons base = read_polygons(*base_obj, PartsBy::group, base_path);
    // Before any shape, so that the cut runs along the same edges for every person.
    const std::vector<std::uint32_t> head_and_neck = head_polygons(base);

    std::vector<std::string> names, notes;
    std::vector<Morph> morphs;
    for (const auto& [path, text] : files.by_name) {
        if (!is_expression(path)) continue;
        std::string name(stem(path));
        if (std::ranges::find(names, name) != names.end()) refuse(path, "the target is in it twice");
        morphs.push_back(read_morph(text, base.positions.size(), name, path));
        names.push_back(std::move(name));
    }
    for (const Shape& shape : shapes) {
        std::string path;
        const Bytes* text = files.find(shape.name + ".target", &path);
        if (!text) refuse("", "there is no " + shape.name + ".target in it");
        apply(read_morph(*text, base.positions.size(), shape.name, path), shape.weight, base.positions);
    }
    if (names.empty()) notes.emplace_back("there are no face units and no visemes in it: the head does not move");

    Bodies bodies;
    for (const Morph& morph : morphs) {
        bodies.push_back(base.positions);
        apply(morph, 1, bodies.back());
    }

    HeadAssembler head(names, least_delta_decimetres);
    Node& root = head.face.nodes.emplace_back();
    root.name = "makeHuman";
    root.rest.scale = glm::vec3(metres_from_decimetres);
    Looks looks(files, head.face, notes);

    const std::vector<glm::dvec3> rest = base.positions;
    const std::int32_t skin = looks.add("skin", 0.5F, {0.58F, 0.36F, 0.27F, 1}, skin_file(files));
    const Surface body(std::move(base), bodies);
    head.add_mesh("head", body, std::vector<Piece>{{skin, head_and_neck}}, 0);

    if (const auto surface = attach(files, eyes, rest, bodies, notes)) add_eyes(*surface, files, looks, head);
    const auto add_part = [&](const PartFiles& part, const std::string& name, std::int32_t material) {
        const auto surface = attach(files, part, rest, bodies, notes);
        if (!surface) return;
        const auto all = polygons_where(surface->polygons(), [](const Polygons::Polygon&) { return true; });
        head.add_mesh(name, *surface, std::vector<Piece>{{material, all}}, 0);
    };
    const auto image = [](const PartFiles& part) { return std::string(part.image) + ".png"; };
    add_part(teeth, "teeth", looks.add("teeth", 0.25F, {0.76F, 0.69F, 0.58F, 1}, image(teeth)));
    add_part(tongue, "tongue", looks.add("tongue", 0.4F, {0.42F, 0.12F, 0.11F, 1}, image(tongue)));
    const std::int32_t lash = looks.add("lashes", 0.6F, {0.012F, 0.008F, 0.006F, 1}, image(lashes));
    looks[lash].double_sided = true;
    if (looks[lash].base_color_srgb.image >= 0) looks[lash].alpha_mode = AlphaMode::blend;
    add_part(lashes, "lashes", lash);
    return write_head(std::move(head.face), looks.images, std::move(notes));
}

}  // namespace
}  // namespace blush::load

namespace blush {

Result<ImportedHead> import_makehuman(const std::filesystem::path& folder_or_archive, const MakeHumanOptions& options) {
    return load::guarded(folder_or_archive, [&]() -> Result<ImportedHead> {
        std::vector<load::Shape> shapes;
        for (const std::string& text : options.shapes) shapes.push_back(load::parse_shape(text));
        return load::import_files(load::read_files(folder_or_archive, shapes), shapes);
    });
}

}  // namespace blush
