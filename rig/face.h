#pragma once
/// Face: everything that a file says about a head, as plain arrays, checked once at load.
///
/// All primitives of all meshes share one vertex numbering, in file order, so that a deformation is one loop (and one
/// stream-out draw) over the whole face. A Face that came out of a loader satisfies every rule in validate(); code that
/// takes one only asserts.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "rig/result.h"
#include "rig/vectors.h"

namespace blush {

/// How far from 1 the length of a unit normal or tangent may be. Files store them in 8 or 16 bits, or as their
/// exporter left them; so near to 1 their own values are kept, so that rest is what the file says to the bit.
inline constexpr float unit_length_tolerance = 0.02F;

/// One blend shape of the face, kept sparse: the vertices that it moves and by how much at weight 1.
/// Targets of one name in several meshes are one Target.
struct Target {
    std::string name;
    std::vector<std::uint32_t> vertices;  ///< face vertex indices, strictly ascending
    std::vector<Vec3> position_deltas;    ///< mesh units, one for each of `vertices`
    std::vector<Vec3> normal_deltas;      ///< one for each of `vertices` (zero where the file has none), or empty
    std::vector<Vec3> tangent_deltas;     ///< one for each of `vertices` (zero where the file has none), or empty
    float default_weight = 0;             ///< the file's own initial weight, any finite value
};

/// Where the shading normal of a primitive's vertices comes from once targets move them.
enum class NormalSource : std::uint8_t {
    rest,        ///< no target moves this primitive
    authored,    ///< every target that moves the primitive has NORMAL deltas
    recomputed,  ///< some target that moves it has none: normals follow the deformed surface
};

struct Primitive {
    std::uint32_t mesh = 0;
    std::uint32_t first_vertex = 0, vertex_count = 0;
    std::uint32_t first_index = 0, index_count = 0;  ///< triangle list into Face::indices
    std::int32_t material = -1;                      ///< -1: the default material
    NormalSource normal_source = NormalSource::rest;
    bool authored_normals = false;   ///< the file had NORMAL; otherwise they were computed from the triangles
    bool authored_tangents = false;  ///< the file had TANGENT; otherwise computed where a normal map needs them
};

struct Mesh {
    std::string name;
    std::uint32_t first_primitive = 0, primitive_count = 0;
};

/// Translation, rotation, scale: parent_from_node = T * R * S (glTF 2.0, 3.5.3).
struct Transform {
    Vec3 translation{0};
    Quat rotation{1, 0, 0, 0};  ///< unit length
    Vec3 scale{1};
};

struct Node {
    std::string name;
    std::int32_t parent = -1;  ///< always less than this node's own index after loading (parents come first)
    Transform rest;
    std::optional<Mat4> matrix;  ///< set when the file gives a matrix instead of a Transform
    std::int32_t mesh = -1;
    std::int32_t skin = -1;
    std::uint32_t file_index = 0;  ///< the node's number in the file, for messages
};

struct Skin {
    std::vector<std::uint32_t> joints;  ///< node indices
    std::vector<Mat4> joint_from_mesh;  ///< inverse bind matrices, one a joint
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// A texture as a material uses it. uv' = uv_transform * (u, v, 1) (KHR_texture_transform).
struct TextureUse {
    std::int32_t image = -1;  ///< index into Face::images, -1: none
    std::uint32_t uv_set = 0;
    Mat3 uv_transform{1};
    bool repeat_u = true, repeat_v = true;
};

struct Material {
    std::string name;
    Vec4 base_color_linear{1};
    float metallic = 1, roughness = 1, normal_scale = 1, occlusion_strength = 1, alpha_cutoff = 0.5F;
    Vec3 emissive_linear{0};
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;
    float specular = 1;  ///< factor on reflection at the surface, 0 to 1 (KHR_materials_specular)
    /// Opacity of the base colour's texture is how far light scatters, 0 to 1 (glTF: extras.blush_scattering is
    /// "base_color_alpha"); of an opaque material only, which has no other use for it.
    bool scatter_by_alpha = false;
    std::optional<bool> skin;  ///< whether the file says that light scatters in it (glTF: extras.blush_skin)
    TextureUse base_color_srgb, metallic_roughness, normal, occlusion, emissive_srgb;
    TextureUse specular_map;  ///< alpha: factor on reflection at the surface
};

/// A decoded image, rows from the top, `channels` interleaved (1 to 4). 8-bit files stay 8-bit, others become float.
struct Image {
    std::string name;
    std::uint32_t width = 0, height = 0, channels = 0;
    std::vector<std::uint8_t> bytes;  ///< width * height * channels, when 8-bit
    std::vector<float> floats;        ///< the same, when not
};

enum class Interpolation : std::uint8_t { step, linear, cubic_spline };
enum class NodePath : std::uint8_t { translation, rotation, scale };

/// Keys of one animated quantity of `width` floats. For cubic_spline `values` holds in-tangent, value, out-tangent of
/// each key (3 * width floats a key), else width floats a key.
struct Track {
    Interpolation interpolation = Interpolation::linear;
    std::uint32_t width = 1;
    std::vector<float> times_seconds;  ///< strictly ascending, finite, at least one
    std::vector<float> values;
};

struct NodeChannel {
    std::uint32_t node = 0;
    NodePath path = NodePath::translation;
    Track track;  ///< width 3, or 4 (x, y, z, w) for a rotation
};

/// A whole vector of weights keyed together, as glTF stores them: value k of a key belongs to targets[k].
struct WeightChannel {
    std::vector<std::uint32_t> targets;  ///< indices into Face::targets
    Track track;                         ///< width == targets.size()
};

struct Animation {
    std::string name;
    std::vector<NodeChannel> nodes;
    std::vector<WeightChannel> weights;
    float duration_seconds = 0;  ///< time of the last key of any channel
};

struct Face {
    std::string path;  ///< where it came from, for messages

    // Vertices, all of one length.
    std::vector<Vec3> positions;  ///< mesh-local, in the file's units
    std::vector<Vec3> normals;    ///< unit length, within unit_length_tolerance
    std::vector<Vec4> tangents;   ///< xyz unit length (same tolerance), w = +1 or -1 (bitangent = cross(n, t.xyz) * w)
    std::vector<Vec2> uv0, uv1;   ///< (0, 0) where the file has none

    // One an entry a vertex if any mesh is skinned, else empty.
    std::vector<U16Vec4> joints;      ///< indices into Skin::joints
    std::vector<Vec4> joint_weights;  ///< sum 1 (all zero: the vertex is not skinned)

    std::vector<std::uint32_t> indices;  ///< face vertex indices
    std::vector<Primitive> primitives;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Skin> skins;
    std::vector<Target> targets;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::vector<Animation> animations;

    std::vector<std::string> notes;  ///< what the loader did not understand or had to mend, one sentence each
};

/// Checks every rule stated above: array lengths, index ranges, finiteness, ascending order, parents before children.
/// Returns the first broken rule as a sentence that starts with face.path.
Status validate(const Face& face);

}  // namespace blush
