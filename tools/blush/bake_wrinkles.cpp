/// blush bake wrinkles: wrinkle maps out of how the face's own expressions press its skin together.

#include <cinttypes>
#include <cstdio>
#include <iostream>

#include "runtime/files/appearance_file.h"
#include "runtime/files/face_file.h"
#include "runtime/files/output_file.h"
#include "runtime/files/wrinkle_bake.h"
#include "tools/blush/assets.h"
#include "tools/blush/baker_options.h"
#include "tools/blush/commands.h"
#include "tools/blush/new_folder.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string face, output;
    BakerOptions baker;
    double millimetres_a_unit = 0;
    bool displacement = false;
};

/// Half floats, for programs that displace.
Status write_displacement(const fs::path& path, const ScalarMap& map) {
    ColourMap colours(map.width, map.height);
    for (std::size_t i = 0; i < map.values.size(); ++i) colours.values[i] = glm::vec3(map.values[i]);
    return write_colour_map(path, colours);
}

void print(const BakedWrinkles& baked) {
    std::printf("%zu zones from %zu poses; %.4g mm a unit; steepest fold %.0f degrees; range %.3g\n",
                baked.set.zones.size(), baked.poses, baked.millimetres_a_unit, baked.steepest_degrees,
                static_cast<double>(baked.set.range));
    const LayoutPart& part = baked.set.part;
    if (!part.is_whole()) {
        std::printf("the maps show u %.3f to %.3f, v %.3f to %.3f of the layout: where skin folds\n",
                    static_cast<double>(part.from.x), static_cast<double>(part.to.x), static_cast<double>(part.from.y),
                    static_cast<double>(part.to.y));
    }
    if (baked.saturated_texels > 0) {
        std::printf("note: %zu texels are steeper than the range holds; they are held to it\n", baked.saturated_texels);
    }
    for (const std::string& zone : baked.empty_zones)
        std::printf("note: no expression presses the zone %s together\n", zone.c_str());
    const WrinkleBytes bytes = wrinkle_bytes(baked.set);
    std::printf("memory: %" PRIu64 " bytes compressed (RGTC2 map %" PRIu64 ", %zu RGBA masks %" PRIu64
                "), mip levels %" PRIu64 " more; the map uncompressed %" PRIu64 "\n",
                bytes.map + bytes.masks, bytes.map, wrinkle_masks_for(baked.set.zones.size()), bytes.masks,
                bytes.mip_levels, bytes.uncompressed_map);
    if (baked.overlapping_texels > 0)
        std::printf("note: %u texels are used by more than one triangle\n", baked.overlapping_texels);
}

Status bake(const Options& options) {
    const Result<Face> face = load_face(face_path(options.face));
    if (!face) return face.error();
    WrinkleBakeOptions settings;
    settings.maps.map_side = options.baker.whole<std::uint32_t>("size");
    settings.maps.mask_side = options.baker.whole<std::uint32_t>("mask_size");
    settings.maps.spacing_mm = static_cast<float>(options.baker.number("spacing"));
    settings.maps.seed = options.baker.whole<std::uint32_t>("seed");
    settings.range = static_cast<float>(options.baker.number("range"));
    settings.millimetres_a_unit = options.millimetres_a_unit;
    settings.whole_layout = options.baker.choice("layout") == "whole";
    const Result<BakedWrinkles> baked = bake_wrinkle_set(*face, settings);
    if (!baked) return baked.error();

    NewFolder folder;
    if (Status made = folder.make(options.output); !made) return made;
    if (Status written = write_wrinkles(options.output, baked->set); !written) return written;
    if (options.displacement) {
        const fs::path path = fs::path(options.output) / "displacement_mm.exr";
        if (Status written = write_displacement(path, baked->displacement_mm); !written) return written;
    }
    print(*baked);
    return Done{};
}

}  // namespace

void add_bake_wrinkles(Command& bake_command) {
    auto options = std::make_shared<Options>();
    Command command =
        bake_command.subcommand("wrinkles", "Wrinkle maps out of how the face's expressions press its skin together");
    command.option("FACE", &options->face, "A .glb, .gltf or .obj file, or \"default\"").required();
    command.option("-o,--output", &options->output, "Folder for the maps, such as FACE.appearance").required();
    options->baker.add_to(command, wrinkle_baker);
    command.option("--millimetres-per-unit", &options->millimetres_a_unit, "Scale of the mesh; told by the pupils")
        .range(1e-6, 1e6);
    command.flag("--displacement", options->displacement, "Also write displacement_mm.exr");
    command.runs([options] {
        const Status baked = bake(*options);
        return baked ? 0 : fail(baked.error());
    });
}

}  // namespace blush::tool
