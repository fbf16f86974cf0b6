#include "runtime/bake/bake_occlusion.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "rig/controls/head_and_eyes.h"
#include "rig/deform/deform.h"
#include "rig/names.h"

namespace blush {
namespace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePointer = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using ScenePointer = std::unique_ptr<RTCSceneTy, ReleaseScene>;

/// A face as it stands in the world.
struct World {
    DeformedSurface surface;         // of the vertices, as the first node that draws them places them
    std::vector<glm::vec3> corners;  // of what hides light, by every node
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Bounds bounds;
};

glm::mat3 normal_matrix(const glm::mat4& m) {
    const glm::vec3 x(m[0]), y(m[1]), z(m[2]);
    const glm::mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    return glm::dot(x, cofactors[0]) < 0 ? -cofactors : cofactors;
}

glm::vec3 unit_or(glm::vec3 v, glm::vec3 otherwise) {
    const float length2 = glm::dot(v, v);
    return length2 > 1e-30F && length2 < 1e37F ? v / std::sqrt(length2) : otherwise;
}

/// Places every node's primitives.
World stand(const Face& face, const DeformedSurface& local) {
    const std::vector<glm::dmat4> rest = rest_placement(face);
    const std::vector<glm::mat4> world_from_node(rest.begin(), rest.end());
    std::size_t joint_count = 0;
    for (const Skin& skin : face.skins) joint_count += skin.joints.size();
    std::vector<glm::mat4> joints(joint_count);
    skinned_from_meshes(face, rest, glm::dvec3(0), joints);

    World world;
    world.surface = local;
    std::vector<std::uint8_t> placed(face.positions.size(), 0);
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(face.nodes[n].mesh)];
        DeformedSurface skinned;
        const bool has_joints = face.nodes[n].skin >= 0 && !face.joints.empty();
        if (has_joints) {
            skinned = local;
            std::size_t first = 0;
            for (std::int32_t s = 0; s < face.nodes[n].skin; ++s)
                first += face.skins[static_cast<std::size_t>(s)].joints.size();
            skin(face.joints, face.joint_weights, std::span(joints).subspan(first), skinned.positions, skinned.normals,
                 skinned.tangents);
        }
        const DeformedSurface& source = has_joints ? skinned : local;
        const glm::mat4 matrix = has_joints ? glm::mat4(1) : world_from_node[n];
        const glm::mat3 normals = normal_matrix(matrix);
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            const auto first_corner = static_cast<std::uint32_t>(world.corners.size());
            for (std::uint32_t i = 0; i < primitive.vertex_count; ++i) {
                const std::uint32_t v = primitive.first_vertex + i;
                const glm::vec3 place(matrix * glm::vec4(source.positions[v], 1));
                world.corners.push_back(place);
                world.bounds.add(place);
                if (placed[v] != 0) continue;
                placed[v] = 1;
                world.surface.positions[v] = place;
                world.surface.normals[v] = unit_or(normals * source.normals[v], source.normals[v]);
                world.surface.tangents[v] =
                    glm::vec4(unit_or(glm::mat3(matrix) * glm::vec3(source.tangents[v]), source.tangents[v]),
                              source.tangents[v].w);
            }
            if (!stops_light(face, primitive)) continue;
            for (std::uint32_t i = 0; i + 2 < primitive.index_count; i += 3) {
                std::array<std::uint32_t, 3> triangle{};
                for (std::uint32_t k = 0; k < 3; ++k) {
                    triangle[k] = first_corner + face.indices[primitive.first_index + i + k] - primitive.first_vertex;
                }
                world.triangles.push_back(triangle);
            }
        }
    }
    return world;
}

ScenePointer make_scene(RTCDevice device, const World& world) {
    ScenePointer scene(rtcNewScene(device));
    // Robust: no ray slips between two triangles that share an edge.
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
    if (!world.triangles.empty()) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                sizeof(glm::vec3), world.corners.size());
        std::ranges::copy(world.corners, static_cast<glm::vec3*>(corners));
        void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  sizeof(world.triangles[0]), world.triangles.size());
        std::ranges::copy(world.triangles, static_cast<std::array<std::uint32_t, 3>*>(triangles));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene.get());
    return scene;
}

constexpr std::size_t packet = 8;

/// Casts eight rays from one place.
void cast(RTCScene scene, glm::vec3 origin, std::span<const glm::vec3> directions, std::span<std::uint8_t> hidden) {
    alignas(32) RTCRay8 rays{};
    alignas(32) std::array<int, packet> valid{};
    for (std::size_t i = 0; i < directions.size(); ++i) {
        valid[i] = -1;
        rays.org_x[i] = origin.x, rays.org_y[i] = origin.y, rays.org_z[i] = origin.z;
        rays.dir_x[i] = directions[i].x, rays.dir_y[i] = directions[i].y, rays.dir_z[i] = directions[i].z;
        rays.tnear[i] = 0;
        rays.tfar[i] = std::numeric_limits<float>::infinity();
        rays.mask[i] = 0xffffffffU;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded8(valid.data(), scene, &context, &rays);
    for (std::size_t i = 0; i < directions.size(); ++i) hidden[i] = rays.tfar[i] < 0 ? 1 : 0;  // Embree says so
}

std::vector<LightTransfer> cast_all(RTCScene scene, const World& world, std::uint32_t rays) {
    const std::vector<glm::dvec3> directions = cosine_directions(rays);
    // Off the surface by two thousandths of the head (a tenth of a millimetre), so that a ray does not meet the
    // triangles that it starts on.
    const float lift = world.bounds.empty() ? 0 : 4e-4F * glm::length(world.bounds.size());
    std::vector<LightTransfer> transfers(world.surface.positions.size());
    std::vector<std::uint8_t> hidden(rays);
    std::array<glm::vec3, packet> turned{};
    for (std::size_t v = 0; v < transfers.size(); ++v) {
        const glm::vec3 normal = world.surface.normals[v];
        const glm::dmat3 frame =
            vertex_frame(glm::normalize(glm::dvec3(normal)), glm::dvec3(world.surface.tangents[v]));
        const glm::vec3 origin = world.surface.positions[v] + lift * normal;
        for (std::size_t d = 0; d < rays; d += packet) {
            const std::size_t count = std::min<std::size_t>(packet, rays - d);
            for (std::size_t i = 0; i < count; ++i) turned[i] = glm::vec3(frame * directions[d + i]);
            cast(scene, origin, std::span(turned).first(count), std::span(hidden).subspan(d, count));
        }
        transfers[v] = transfer_of(directions, hidden);
    }
    return transfers;
}

}  // namespace

std::vector<std::string> usual_occlusion_targets(const Face& face) {
    std::vector<std::string> names, found;
    for (const Target& target : face.targets) names.push_back(target.name);
    for (const char* wanted : {"jawOpen", "eyeBlinkLeft", "eyeBlinkRight"}) {
        if (const auto index = find_name(wanted, names)) found.push_back(names[*index]);
    }
    return found;
}

Result<OcclusionSet> bake_occlusion(const Face& face, const OcclusionBake& options) {
    if (1 + options.targets.size() > most_occlusion_poses) {
        return Error{face.path + ": " + std::to_string(options.targets.size()) + " poses beside rest; " +
                     std::to_string(most_occlusion_poses - 1) + " are taken at most"};
    }
    const DevicePointer device(rtcNewDevice(nullptr));
    if (!device) return Error{"Embree does not start: error " + std::to_string(rtcGetDeviceError(nullptr))};
    OcclusionSet set;
    set.face_identity = occlusion_identity(face);
    Deformer deformer(face);
    DeformedSurface surface;
    std::vector<std::string> poses = {""};
    poses.insert(poses.end(), options.targets.begin(), options.targets.end());
    for (const std::string& pose : poses) {
        std::vector<float> weights(face.targets.size(), 0.0F);
        if (!pose.empty()) {
            const auto target = std::ranges::find(face.targets, pose, &Target::name);
            if (target == face.targets.end()) return Error{face.path + ": it has no target \"" + pose + "\""};
            weights[static_cast<std::size_t>(target - face.targets.begin())] = 1;
        }
        deformer.deform(weights, NormalMethod::authored, surface);
        const World world = stand(face, surface);
        const ScenePointer scene = make_scene(device.get(), world);
        set.poses.push_back({pose, cast_all(scene.get(), world, options.rays)});
        fill_shut_vertices(face.indices, set.poses.back().transfers);
        if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE) {
            return Error{face.path + ": Embree fails with error " + std::to_string(error)};
        }
    }
    return set;
}

}  // namespace blush
