/// blush bake smaa-tables: SMAA's area and search tables as images, in the layout that published shaders read.

#include <iostream>

#include "rig/antialias/smaa_tables.h"
#include "runtime/files/picture_file.h"
#include "tools/blush/commands.h"
#include "tools/blush/new_folder.h"

namespace blush::tool {
namespace {

int bake(const std::filesystem::path& folder) {
    NewFolder made;
    if (Status ready = made.make(folder); !ready) return fail(ready.error());
    const auto write = [&](const char* name, int width, int height, std::uint32_t channels,
                           std::vector<std::uint8_t> bytes) -> Status {
        PictureFile picture;
        picture.linear = true;
        picture.image = {.name = {},
                         .width = static_cast<std::uint32_t>(width),
                         .height = static_cast<std::uint32_t>(height),
                         .channels = channels,
                         .bytes = std::move(bytes),
                         .floats = {}};
        const std::filesystem::path path = folder / name;
        if (Status written = write_picture(path, picture); !written) return written;
        std::cout << path.string() << ": " << width << "x" << height << ", " << channels
                  << (channels == 1 ? " channel\n" : " channels\n");
        return Done{};
    };
    AreaImage areas = published_area_image();
    if (Status written = write("smaa_areas.png", areas.width, areas.height, 2, std::move(areas.near_far)); !written) {
        return fail(written.error());
    }
    if (Status written = write("smaa_search.png", search_table_width, search_table_height, 1, search_table());
        !written) {
        return fail(written.error());
    }
    return 0;
}

}  // namespace

void add_bake_smaa_tables(Command& bake_command) {
    auto folder = std::make_shared<std::string>();
    Command command = bake_command.subcommand(
        "smaa-tables",
        "Write smaa_areas.png (160x560, gray and alpha: areas on either side of an edge, seven subsample offsets of 80 "
        "rows) and smaa_search.png (64x16), as published shaders read them");
    command.option("-o,--output", folder.get(), "A folder; it is made where it is missing").required();
    command.runs([folder] { return bake(*folder); });
}

}  // namespace blush::tool
