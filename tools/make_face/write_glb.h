#pragma once
/// The face as one binary glTF 2.0 file.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rig/blood/appearance.h"
#include "rig/result.h"
#include "tools/make_face/mesh.h"

namespace blush::make_face {

/// A blend shape, dense; the file keeps only what moves.
struct ShapeTarget {
    std::string name;
    std::vector<Vec3> position_deltas;  ///< millimetres at weight 1
    std::vector<Vec3> normal_deltas;
};

struct MaterialPart {
    std::string name;
    std::array<double, 4> base_color_linear{1, 1, 1, 1};
    double roughness = 0.5;
    std::vector<unsigned char> base_color_png{}, normal_png{}, roughness_png{}, specular_png{};  ///< empty: none
    double normal_scale = 1;
    bool double_sided = false;
    bool blended = false;   ///< the base colour's alpha is coverage
    bool occluded = false;  ///< red of roughness_png is occlusion
};

struct MeshPart {
    std::string name;
    Mesh mesh;
    std::size_t material = 0;
    std::vector<ShapeTarget> targets;
};

struct NodePart {
    std::string name;
    Vec3 translation_mm{0};
    int mesh = -1;  ///< index into FaceParts::meshes
};

/// Everything that the file holds. The first node is the root; the others are its children.
struct FaceParts {
    std::vector<MaterialPart> materials;
    std::vector<MeshPart> meshes;
    std::vector<NodePart> nodes;
    std::optional<AppearanceMaps> pigments;  ///< what the skin's colour was made from; not in the .glb
};

/// The bytes of the .glb, in metres; the same parts give the same bytes. A delta shorter than 0.5 micrometres counts as
/// none.
std::string glb_bytes(const FaceParts& parts);

/// Whether a file can be made at the path; nothing is left behind.
Status check_writable(const std::filesystem::path& path);

/// Writes beside the path and renames. The error names the path and the reason.
Status write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace blush::make_face
