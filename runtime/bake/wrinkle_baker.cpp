/// The baker of wrinkle maps (`blush bake wrinkles`): work that was done before any frame, so that frames do not do it.

#include <algorithm>
#include <array>

#include "rig/face.h"
#include "runtime/bake/baker.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> parts = {"folds", "whole"};
constexpr std::array<Setting, 6> settings = {{
    {.name = "size",
     .meaning = "texels of a side of the wrinkle map",
     .lowest = 16,
     .highest = 4096,
     .default_number = 256},
    {.name = "mask_size",
     .meaning = "texels of a side of the masks",
     .lowest = 4,
     .highest = 4096,
     .default_number = 64},
    {.name = "spacing", .meaning = "from fold to fold, millimetres", .lowest = 0.5, .highest = 50, .default_number = 8},
    {.name = "range",
     .meaning = "derivative that 8 bits end at (1 is 45 degrees, 4 is 76); 0: the steepest fold's",
     .lowest = 0,
     .highest = 100,
     .default_number = 0},
    {.name = "seed",
     .meaning = "another number, other folds",
     .lowest = 0,
     .highest = 4294967295.0,
     .default_number = 1},
    {"layout",
     "folds: maps of the part of the texture layout where skin folds, so that their texels are small there; whole: of "
     "all of it",
     parts},
}};

constexpr std::array<HardCase, 2> hard_cases = {{
    {"texture coordinates without an area", "no folds, and finite",
     [](Face& face) { std::ranges::fill(face.uv0, glm::vec2(0.5F)); }},
    {"targets that press everything into one point", "draws nothing, and finite",
     [](Face& face) {
         for (Target& target : face.targets) {
             for (std::size_t i = 0; i < target.vertices.size(); ++i)
                 target.position_deltas[i] = -face.positions[target.vertices[i]];
         }
     }},
}};

}  // namespace

const Baker wrinkle_baker = {
    .name = "wrinkle_baking",
    .what = "finds ahead of time where and how the skin folds",
    .settings = settings,
    .hard_cases = hard_cases,
};

}  // namespace blush
