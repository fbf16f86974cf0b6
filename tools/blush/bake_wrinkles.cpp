/// blush bake wrinkles: wrinkle maps out of how the face's own expressions press its skin together.

#include <cstdio>
#include <iostream>

#include "rig/canonical_face.h"
#include "rig/wrinkle_sources.h"
#include "runtime/appearance_file.h"
#include "runtime/face_file.h"
#include "runtime/output_file.h"
#include "runtime/wrinkle_file.h"
#include "tools/blush/new_folder.h"
#include "tools/blush/options.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string face, output;
    WrinkleBake bake;
    double millimetres_a_unit = 0, spacing_mm = 0, range = 0;
    bool displacement = false;
};

/// By the distance of its pupils, as the eyelids' targets tell it; 0 where they do not.
double millimetres_of(const Face& face, std::span<const std::uint32_t> skin) {
    const std::optional<FaceLandmarks> landmarks = landmarks_from_targets(face, skin);
    if (!landmarks) return 0;
    const auto apart = static_cast<double>(glm::distance(landmarks->left_eye, landmarks->right_eye));
    return apart > 0 ? 2 * static_cast<double>(canonical_pupil_mm) / apart : 0;
}

/// Half floats, for programs that displace.
Status write_displacement(const fs::path& path, const ScalarMap& map) {
    ColourMap colours(map.width, map.height);
    for (std::size_t i = 0; i < map.values.size(); ++i) colours.values[i] = glm::vec3(map.values[i]);
    return write_colour_map(path, colours);
}

Status bake(const Options& options) {
    const Result<Face> face = load_face(face_path(options.face));
    if (!face) return face.error();
    const std::vector<std::uint32_t> skin = skin_primitives(*face);
    if (skin.empty()) {
        return Error{face->path +
                     ": no targets like eyeBlinkLeft and mouthSmileLeft move one part of it, so that its "
                     "skin cannot be told from the rest"};
    }
    std::vector<std::uint8_t> wanted(face->primitives.size(), 0);
    for (const std::uint32_t primitive : skin) wanted[primitive] = 1;

    WrinkleBake settings = options.bake;
    const double scale = options.millimetres_a_unit > 0 ? options.millimetres_a_unit : millimetres_of(*face, skin);
    if (scale <= 0) return Error{face->path + ": its scale cannot be told; name it with --millimetres-per-unit"};
    settings.millimetres_a_unit = static_cast<float>(scale);
    settings.spacing_mm = static_cast<float>(options.spacing_mm);

    const RigDescription description = default_description(*face);
    const Rig rig(*face, description);
    const std::vector<WrinkleSource> sources = wrinkle_sources(rig, description);
    if (sources.empty()) return Error{face->path + ": none of its expressions wrinkles a zone"};
    if (rig.wrinkle_zones().size() > most_wrinkle_zones) {
        return Error{face->path + ": its rig has " + std::to_string(rig.wrinkle_zones().size()) +
                     " wrinkle zones; two masks hold " + std::to_string(most_wrinkle_zones)};
    }
    const WrinkleMaps maps = bake_wrinkles(*face, wanted, sources, settings);

    NewFolder folder;
    if (Status made = folder.make(options.output); !made) return made;
    WrinkleSet set;
    set.zones.assign(rig.wrinkle_zones().begin(), rig.wrinkle_zones().end());
    set.range = static_cast<float>(options.range);
    set.derivatives = maps.derivatives;
    double steepest = 0;
    for (glm::vec2& derivative : set.derivatives.values) {
        steepest = std::max(steepest, static_cast<double>(glm::length(derivative)));
        derivative = glm::clamp(derivative, glm::vec2(-set.range), glm::vec2(set.range));
    }
    set.masks = maps.masks;
    if (Status written = write_wrinkles(options.output, set); !written) return written;
    if (options.displacement) {
        const fs::path path = fs::path(options.output) / "displacement_mm.exr";
        if (Status written = write_displacement(path, maps.displacement_mm); !written) return written;
    }

    const std::size_t map_texels = set.derivatives.values.size(), mask_texels = set.masks[0].values.size();
    std::printf("%zu zones from %zu poses; %.4g mm a unit; steepest fold %.0f degrees\n", set.zones.size(),
                sources.size(), scale, glm::degrees(std::atan(steepest)));
    for (std::size_t zone = 0; zone < set.zones.size(); ++zone) {
        float sum = 0;
        for (const float value : set.masks[zone].values) sum += value;
        if (sum == 0) std::printf("note: no expression presses the zone %s together\n", set.zones[zone].c_str());
    }
    std::printf("memory: %zu bytes compressed (RGTC2 map %zu, two RGBA masks %zu); %zu bytes plain\n",
                map_texels + 8 * mask_texels, map_texels, 8 * mask_texels, 2 * map_texels + 8 * mask_texels);
    if (maps.raster.overlaps > 0)
        std::printf("note: %u texels are used by more than one triangle\n", maps.raster.overlaps);
    return Done{};
}

}  // namespace

void add_bake_wrinkles(CLI::App& bake_command, int& exit_status) {
    auto options = std::make_shared<Options>();
    options->spacing_mm = static_cast<double>(options->bake.spacing_mm);
    options->range = static_cast<double>(published_derivative_range);
    CLI::App* command = bake_command.add_subcommand(
        "wrinkles", "Wrinkle maps out of how the face's expressions press its skin together");
    command->add_option("FACE", options->face, "A .glb, .gltf or .obj file, or \"default\"")->required();
    command->add_option("-o,--output", options->output, "Folder for the maps, such as FACE.appearance")->required();
    command->add_option("--size", options->bake.map_side, "Texels of a side of the wrinkle map")
        ->check(CLI::Range(16U, 4096U))
        ->capture_default_str();
    command->add_option("--mask-size", options->bake.mask_side, "Texels of a side of the masks")
        ->check(CLI::Range(4U, 4096U))
        ->capture_default_str();
    command->add_option("--spacing", options->spacing_mm, "From fold to fold, millimetres")
        ->check(number_from(0.5, 50))
        ->capture_default_str();
    command->add_option("--range", options->range, "Steepest derivative that 8 bits hold: 1 is 45 degrees, 4 is 76")
        ->check(number_from(0.1, static_cast<double>(largest_derivative_range)))
        ->capture_default_str();
    command->add_option("--seed", options->bake.seed, "Another number, other folds")->capture_default_str();
    command->add_option("--millimetres-per-unit", options->millimetres_a_unit, "Scale of the mesh; told by the pupils")
        ->check(number_from(1e-6, 1e6));
    command->add_flag("--displacement", options->displacement, "Also write displacement_mm.exr");
    command->callback([options, &exit_status] {
        if (Status baked = bake(*options); !baked) exit_status = fail(baked.error());
    });
}

}  // namespace blush::tool
