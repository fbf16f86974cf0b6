/// The baker of pigment maps (`blush bake appearance`): work that was done before any frame, so that frames do not do
/// it.

#include <array>

#include "rig/face.h"
#include "runtime/bake/baker.h"

namespace blush {
namespace {

constexpr std::array<Setting, 4> settings = {{
    {.name = "size",
     .meaning = "longest side of the maps, texels; larger textures are reduced",
     .lowest = 1,
     .highest = 16'384,
     .default_number = 2048},
    {.name = "change_size",
     .meaning = "texels of a side of the maps of scale and offset of each expression",
     .lowest = 4,
     .highest = 4096,
     .default_number = 256},
    {.name = "radius",
     .meaning = "radius of the disc of the local statistics (jimenez-2012, eq. 7.1), as a share of the maps' width",
     .lowest = 0,
     .highest = 100,
     .default_number = 0.03125},
    {.name = "lightness",
     .meaning = "how much of lightness is pigment: 1 all (shadows become melanin), 0 none (all is light)",
     .lowest = 0,
     .highest = 1,
     .default_number = 0.35},
}};

constexpr std::array<HardCase, 1> hard_cases = {{
    {"texture of one black texel", "keeps its colour, and finite",
     [](Face& face) {
         for (Image& image : face.images) image = {image.name, 1, 1, 4, {0, 0, 0, 255}, {}};
     }},
}};

}  // namespace

const Baker appearance_baker = {
    .name = "appearance_baking",
    .what = "finds ahead of time what pigments colour the skin",
    .settings = settings,
    .hard_cases = hard_cases,
};

}  // namespace blush
