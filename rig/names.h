#pragma once
/// Names of facial controls: ARKit's 52, their usual spellings, and the match between two vocabularies.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

namespace blush {

/// ARKit's blend-shape locations in their lowerCamelCase spelling ("jawOpen", "mouthSmileLeft").
/// Source: Apple, ARFaceAnchor.BlendShapeLocation.
extern const std::array<std::string_view, 52> arkit_names;

/// One spelling for all the usual ones: "JawOpen", "jaw_open", "mouthSmile_L" and "mouthSmileLeft" give the same key.
/// Case, '_', '-', ' ', '.' do not count, and a final side mark (L, R after a separator, a lower-case letter or a
/// digit; left, right) becomes one form. Names that are not ARKit's are folded the same way.
std::string canonical_name(std::string_view name);

/// A list of names prepared for many look-ups by find_name()'s rule: as many steps to build as there are names, one to
/// find.
class NameIndex {
public:
    NameIndex() = default;
    explicit NameIndex(std::span<const std::string> names);
    std::optional<std::size_t> find(std::string_view name) const;

private:
    std::unordered_map<std::string, std::size_t> identical_, canonical_, without_prefix_;
};

/// The entry of `names` that `name` means: the identical one first, else the only one of the same canonical form. If
/// there is none, what stands before the last '.' ("blendShape1.jawOpen") is dropped on both sides, and the only one of
/// the same canonical form is taken. Several that fit equally well are no match.
std::optional<std::size_t> find_name(std::string_view name, std::span<const std::string> names);

/// The entry of `names` closest in spelling, for "did you mean"; nothing when none is near.
std::optional<std::string> nearest_name(std::string_view name, std::span<const std::string> names);

}  // namespace blush
