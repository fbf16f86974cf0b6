#include "rig/head/material_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "rig/head/skin_material.h"

namespace blush {
namespace {

template <std::size_t N>
bool holds_any(std::string_view name, const std::array<std::string_view, N>& words) {
    return std::ranges::any_of(words,
                               [name](std::string_view word) { return name.find(word) != std::string_view::npos; });
}

MaterialKind kind_of(std::string name) {
    constexpr std::array<std::string_view, 6> hair = {"lash", "brow", "hair", "beard", "stubble", "moustache"};
    // Films over the eye and its surroundings, which are no eyeball.
    constexpr std::array<std::string_view, 6> films = {"occlusion", "lacrimal", "tear",
                                                       "meniscus",  "caruncle", "blend"};
    constexpr std::array<std::string_view, 5> eye = {"eye", "sclera", "iris", "cornea", "pupil"};
    constexpr std::array<std::string_view, 5> mouth = {"teeth", "tooth", "gum", "tongue", "mouth"};
    std::ranges::transform(name, name.begin(),
                           [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    if (holds_any(name, hair)) return MaterialKind::hair;
    if (holds_any(name, films)) return MaterialKind::other;
    if (holds_any(name, eye)) return MaterialKind::eye;
    return holds_any(name, mouth) ? MaterialKind::mouth : MaterialKind::other;
}

}  // namespace

std::vector<MaterialKind> material_kinds(const Face& face) {
    const std::vector<bool> skin = skin_materials(face);
    std::vector<MaterialKind> kinds;
    for (std::size_t m = 0; m < skin.size(); ++m) {
        const bool named = m < face.materials.size();
        kinds.push_back(skin[m] ? MaterialKind::skin : named ? kind_of(face.materials[m].name) : MaterialKind::other);
    }
    return kinds;
}

}  // namespace blush
