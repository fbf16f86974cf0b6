/// blush bake appearance: melanin and hemoglobin out of a colour texture, and what each expression does to the blood.

#include <cstdio>
#include <iostream>
#include <optional>

#include "rig/blood/appearance_transfer.h"
#include "rig/blood/skin_inversion.h"
#include "runtime/files/appearance_file.h"
#include "runtime/files/face_appearance.h"
#include "runtime/files/face_file.h"
#include "tools/blush/assets.h"
#include "tools/blush/baker_options.h"
#include "tools/blush/commands.h"
#include "tools/blush/new_folder.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string face, albedo, mask, landmarks, patterns, from, output;
    BakerOptions baker;
    std::optional<float> typical_melanin, typical_hemoglobin;
    bool preview = false;
};

/// Blood changes over centimetres: a texel of 5 mm on the texture of a head.
constexpr std::uint32_t one_colour_side = 128;

/// The colour texture of the face's skin, or its one colour as a small texture.
Result<ColourMap> albedo_of(const Face& face, std::span<const std::uint32_t> skin) {
    std::optional<ColourMap> one_colour;
    for (const std::uint32_t p : skin) {
        const std::int32_t material = face.primitives[p].material;
        if (material < 0) continue;
        const glm::vec3 colour(face.materials[static_cast<std::size_t>(material)].base_color_linear);
        if (!one_colour && colour != glm::vec3(1)) one_colour = ColourMap(one_colour_side, one_colour_side, colour);
        const std::int32_t image = face.materials[static_cast<std::size_t>(material)].base_color_srgb.image;
        if (image < 0) continue;
        const Image& texture = face.images[static_cast<std::size_t>(image)];
        return colour_map_of(texture, face.path + ": image \"" + texture.name + "\"");
    }
    if (one_colour) return *one_colour;
    return Error{face.path + ": its skin has no colour texture; name one with --albedo"};
}

void shrink(ColourMap& map, std::uint32_t most) {
    const std::uint32_t longer = std::max(map.width, map.height);
    if (longer <= most) return;
    const auto side = [&](std::uint32_t full) {
        return std::max(1U, static_cast<std::uint32_t>(std::uint64_t{full} * most / longer));
    };
    map = resized(map, side(map.width), side(map.height));
}

struct Inputs {
    ColourMap albedo;
    std::optional<ScalarMap> coverage;      ///< of the albedo's size
    std::optional<CanonicalMap> canonical;  ///< of the maps' own low resolution
    std::vector<HemoglobinPattern> patterns;
    struct Other {
        SkinPigments pigments;
        CanonicalMap canonical;  ///< of the size of its changes
    };
    std::optional<Other> other;  ///< whose expressions are taken, in place of patterns
};

/// The face that --from names, with the maps beside it.
Result<Inputs::Other> read_other(const std::string& name) {
    const fs::path path = face_path(name), folder = appearance_folder(path);
    const Result<Face> face = load_face(path);
    if (!face) return face.error();
    Result<FaceAppearance> appearance = load_face_appearance(folder);
    if (!appearance) return appearance.error();
    if (!appearance->pigments || appearance->pigments->blood.changes.empty()) {
        return Error{folder.string() + ": no maps of an expression's blood are here to take (blush bake appearance " +
                     name + " -o " + folder.string() + " makes them)"};
    }
    const std::vector<std::uint32_t> skin = skin_primitives(*face);
    const std::optional<FaceLandmarks> landmarks = landmarks_from_targets(*face, skin);
    const ScalarMap& layout = appearance->pigments->blood.changes[0].scale;
    const std::optional<CanonicalMap> canonical =
        landmarks ? canonical_map(*face, skin, CanonicalFrame(*landmarks), layout.width, layout.height) : std::nullopt;
    if (!canonical) return Error{face->path + ": its targets do not tell where eyes and mouth are in its texture"};
    return Inputs::Other{*std::move(appearance->pigments), *canonical};
}

Status read_face(const Options& options, Inputs& inputs) {
    const Result<Face> face = load_face(face_path(options.face));
    if (!face) return face.error();
    const std::vector<std::uint32_t> skin = skin_primitives(*face);
    const std::optional<FaceLandmarks> landmarks = landmarks_from_targets(*face, skin);
    if (!landmarks && options.landmarks.empty()) {
        return Error{face->path +
                     ": eyes and mouth cannot be found, for no targets like eyeBlinkLeft and "
                     "mouthSmileLeft move its skin; name their places in the texture with --landmarks"};
    }
    if (options.albedo.empty()) {
        Result<ColourMap> albedo = albedo_of(*face, skin);
        if (!albedo) return albedo.error();
        inputs.albedo = *std::move(albedo);
        shrink(inputs.albedo, options.baker.whole<std::uint32_t>("size"));
    }
    if (!landmarks) return Done{};
    const CanonicalFrame frame(*landmarks);
    const auto canonical_side = options.baker.whole<std::uint32_t>("change_size");
    inputs.canonical = canonical_map(*face, skin, frame, canonical_side, canonical_side);
    const std::optional<CanonicalMap> full =
        canonical_map(*face, skin, frame, inputs.albedo.width, inputs.albedo.height);
    if (!inputs.canonical || !full) {
        return Error{face->path + ": its skin has no texture coordinates that span a texture"};
    }
    // Filtering at the edge of a chart reaches beyond it; a rim of skin keeps the edge from showing when blood changes.
    constexpr float rim_texels = 4;
    inputs.coverage = local_statistics(full->coverage, rim_texels).mean;
    return Done{};
}

Result<Inputs> read_inputs(const Options& options) {
    Inputs inputs;
    if (!options.albedo.empty()) {
        Result<ColourMap> albedo = load_colour_map(options.albedo);
        if (!albedo) return albedo.error();
        inputs.albedo = *std::move(albedo);
        shrink(inputs.albedo, options.baker.whole<std::uint32_t>("size"));
    }
    if (!options.face.empty()) {
        if (Status read = read_face(options, inputs); !read) return read.error();
    }
    if (inputs.albedo.values.empty()) return Error{"bake appearance: name a FACE, an --albedo, or both"};
    if (!options.mask.empty()) {
        const Result<ScalarMap> mask = load_scalar_map(options.mask);
        if (!mask) return mask.error();
        const ScalarMap fitted = resized(*mask, inputs.albedo.width, inputs.albedo.height);
        if (!inputs.coverage) inputs.coverage = ScalarMap(fitted.width, fitted.height, 1);
        for (std::size_t i = 0; i < fitted.values.size(); ++i) {
            if (!(fitted.values[i] >= 0.5F)) inputs.coverage->values[i] = 0;
        }
    }
    if (!options.landmarks.empty()) {
        const Result<TextureLandmarks> places = load_texture_landmarks(options.landmarks);
        if (!places) return places.error();
        const auto canonical_side = options.baker.whole<std::uint32_t>("change_size");
        inputs.canonical = canonical_map(*places, canonical_side, canonical_side);
        if (!inputs.canonical) return Error{options.landmarks + ": eyes and mouth lie on one line"};
    }
    if (!options.from.empty()) {
        if (!inputs.canonical) {
            return Error{"bake appearance: --from " + options.from +
                         " needs a FACE or --landmarks to know where its blood goes"};
        }
        Result<Inputs::Other> other = read_other(options.from);
        if (!other) return other.error();
        inputs.other = *std::move(other);
    } else if (inputs.canonical) {
        const fs::path folder = options.patterns.empty() ? asset_folder() / "hemoglobin" : fs::path(options.patterns);
        Result<std::vector<HemoglobinPattern>> patterns = load_hemoglobin_patterns(folder);
        if (!patterns) return patterns.error();
        inputs.patterns = *std::move(patterns);
    }
    return inputs;
}

/// What the face looks like with each expression, flat: for the eye.
Status write_previews(const fs::path& folder, const AppearanceMaps& maps, const HemoglobinMaps& blood,
                      const SkinColourTable& table) {
    if (Status s = write_colour_map(folder / "recomposed.png", recomposed(maps, table)); !s) return s;
    for (std::size_t i = 0; i < blood.names.size(); ++i) {
        const float weight = 1;
        AppearanceMaps changed = maps;
        changed.hemoglobin =
            blended_hemoglobin(maps.hemoglobin, maps.skin, std::span(&weight, 1), std::span(&blood.changes[i], 1));
        if (Status s = write_colour_map(folder / (blood.names[i] + ".png"), recomposed(changed, table)); !s) return s;
    }
    return Done{};
}

void print(const AppearanceMaps& maps, const AlbedoReport& report) {
    const auto d = [](float value) { return static_cast<double>(value); };
    std::printf("%u x %u texels, %.1f %% of them skin\n", maps.skin.width, maps.skin.height, 100 * report.skin_share);
    std::printf("typical skin: melanin %.4f, hemoglobin %.4f; white of the picture %.3f %.3f %.3f\n",
                d(report.typical_melanin), d(report.typical_hemoglobin), d(report.white_linear.r),
                d(report.white_linear.g), d(report.white_linear.b));
    std::printf("CIEDE2000 to the texture: %.2f median, %.2f 99th percentile with light; %.2f median without\n",
                d(report.median_difference), d(report.percentile_99_difference), d(report.median_unshaded_difference));
    if (report.skin_share < 0.05) {
        std::printf("note: hardly any of this texture has the colour of skin; blood will change little\n");
    }
}

int bake(const Options& options) {
    const Result<Inputs> inputs = read_inputs(options);
    if (!inputs) return fail(inputs.error());
    NewFolder folder;
    if (Status made = folder.make(options.output); !made) return fail(made.error());
    AlbedoOptions separation;
    separation.lightness_weight = static_cast<float>(options.baker.number("lightness"));
    separation.typical_melanin = options.typical_melanin;
    separation.typical_hemoglobin = options.typical_hemoglobin;
    const std::optional<ScalarMap> face =
        inputs->canonical ? std::optional(face_region(*inputs->canonical)) : std::nullopt;
    separation.typical_region = face ? &*face : nullptr;
    const SkinColourTable table;
    AlbedoReport report;
    const AppearanceMaps maps = appearance_from_albedo(inputs->albedo, table, separation,
                                                       inputs->coverage ? &*inputs->coverage : nullptr, &report);
    if (Status s = write_appearance(options.output, maps); !s) return fail(s.error());
    HemoglobinMaps blood;
    if (inputs->canonical) {
        HemoglobinMapOptions layout;
        layout.side = options.baker.whole<std::uint32_t>("change_size");
        layout.radius = static_cast<float>(options.baker.number("radius"));
        blood = inputs->other ? transferred_maps(inputs->other->pigments.blood,
                                                 {inputs->other->pigments.maps, inputs->other->canonical},
                                                 {maps, *inputs->canonical}, layout)
                              : hemoglobin_maps(maps, *inputs->canonical, inputs->patterns, layout);
        if (Status s = write_hemoglobin_maps(options.output, blood); !s) return fail(s.error());
    }
    if (options.preview) {
        if (Status s = write_previews(options.output, maps, blood, table); !s) return fail(s.error());
    }
    print(maps, report);
    return 0;
}

}  // namespace

void add_bake_appearance(Command& bake_command) {
    auto options = std::make_shared<Options>();
    Command command = bake_command.subcommand(
        "appearance", "Melanin and hemoglobin out of a colour texture, and what each expression does to the blood");
    command.option("FACE", &options->face,
                   "The face whose texture this is (its own texture where --albedo is not given)");
    command.option("--albedo", &options->albedo, "Colour texture: PNG, JPEG, WebP (sRGB), HDR or EXR (linear)");
    command.option("-o,--output", &options->output, "Folder for the maps").required();
    command.option("--mask", &options->mask, "Picture that is bright where the texture is skin");
    command.option("--landmarks", &options->landmarks, "JSON with left_eye, right_eye and mouth in the texture");
    command.option("--patterns", &options->patterns, "Folder of hemoglobin patterns instead of the shipped ones");
    command.option("--from", &options->from,
                   "Another face with maps beside it: its expressions' blood instead of the shipped patterns");
    options->baker.add_to(command, appearance_baker);
    command.option("--melanin", &options->typical_melanin, "Melanin fraction of the typical skin, where known")
        .range(0, largest_melanin);
    command.option("--hemoglobin", &options->typical_hemoglobin, "Hemoglobin fraction of the typical skin, where known")
        .range(0, largest_hemoglobin);
    command.flag("--preview", options->preview, "Also write the recomposed texture, and one for each expression");
    command.runs([options] { return bake(*options); });
}

}  // namespace blush::tool
