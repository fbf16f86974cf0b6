#include "rig/head/skin_material.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace blush {
namespace {

// Parts of a head, as files name their materials. A name may hold several ("eyelash", "head_teeth"): what is not skin
// is looked for first, and the whole words that look like it ("eyelid") before that.
constexpr std::array<std::string_view, 3> skin_though_it_holds_another = {"eyelid", "forehead", "headskin"};
constexpr std::array<std::string_view, 30> never_skin = {
    "eye",   "lash",   "brow",   "hair",  "beard", "stubble", "teeth",     "tooth",    "tongue",   "gum",
    "iris",  "cornea", "sclera", "pupil", "lens",  "tear",    "caruncle",  "mouth",    "saliva",   "nail",
    "cloth", "shirt",  "collar", "hat",   "glass", "metal",   "occlusion", "lacrimal", "meniscus", "scalp_cap"};
constexpr std::array<std::string_view, 8> always_skin = {"skin", "face", "head", "body",
                                                         "neck", "ears", "lips", "nose"};

enum class Named : std::uint8_t { skin, other, nothing };

bool holds(std::string_view name, std::string_view word) { return name.find(word) != std::string_view::npos; }

template <std::size_t N>
bool holds_any(std::string_view name, const std::array<std::string_view, N>& words) {
    return std::ranges::any_of(words, [name](std::string_view word) { return holds(name, word); });
}

Named named(const std::string& material_name) {
    std::string name = material_name;
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (holds_any(name, skin_though_it_holds_another)) return Named::skin;
    if (holds_any(name, never_skin)) return Named::other;
    if (holds_any(name, always_skin)) return Named::skin;
    return Named::nothing;
}

}  // namespace

std::vector<bool> skin_materials(const Face& face) {
    const std::size_t count = face.materials.size();
    std::vector<bool> skin(count + 1, false);
    std::vector<bool> possible(count + 1, true);
    bool any_named = false;
    for (std::size_t m = 0; m < count; ++m) {
        const Material& material = face.materials[m];
        const Named name = named(material.name);
        const bool blended = material.alpha_mode == AlphaMode::blend;
        skin[m] = !blended && material.skin.value_or(name == Named::skin);
        possible[m] = !blended && name != Named::other && !material.skin.has_value();
        any_named = any_named || skin[m];
    }
    if (any_named) return skin;
    std::vector<std::uint64_t> used(count + 1, 0);
    for (const Primitive& primitive : face.primitives) {
        const std::size_t m = primitive.material < 0 ? count : static_cast<std::size_t>(primitive.material);
        if (possible[m]) used[m] += primitive.index_count;
    }
    const auto most = std::ranges::max_element(used);
    if (*most > 0) skin[static_cast<std::size_t>(most - used.begin())] = true;
    return skin;
}

double millimetres_a_unit(const Bounds& bounds) {
    // Height of a head with the beginning of its neck: 232 mm for an adult man from vertex to chin (Farkas 1994), and a
    // little of what is below.
    constexpr double head_mm = 240;
    if (bounds.empty()) return head_mm;
    const glm::dvec3 size(bounds.size());
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent > 1e-9) || !std::isfinite(extent)) return head_mm;
    // From the smallest child's head to a bust with its shoulders.
    const bool metres = extent >= 0.15 && extent <= 0.6;
    return metres ? 1000 : std::clamp(head_mm / extent, 1e-9, 1e9);
}

}  // namespace blush
