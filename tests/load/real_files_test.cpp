// Real heads and the Khronos samples, with values worked out by hand from the files' own JSON and bytes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "runtime/files/face_file.h"
#include "tests/rotation.h"
#include "tests/shared_data.h"

namespace blush {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

glm::mat4 parent_from_node(const Node& node) {
    if (node.matrix) return *node.matrix;
    const glm::mat3 rotation = glm::mat3_cast(glm_of(node.rest.rotation));
    glm::mat4 m(1);
    for (int c = 0; c < 3; ++c) m[c] = glm::vec4(rotation[c] * node.rest.scale[c], 0);
    m[3] = glm::vec4(node.rest.translation, 1);
    return m;
}

const Node& node_of_mesh(const Face& face, std::int32_t mesh) {
    return *std::ranges::find(face.nodes, mesh, &Node::mesh);
}

/// Dense position deltas of a target over the vertices of a primitive.
std::vector<glm::vec3> dense(const Target& target, const Primitive& primitive) {
    std::vector<glm::vec3> deltas(primitive.vertex_count, glm::vec3(0));
    for (std::size_t i = 0; i < target.vertices.size(); ++i) {
        if (target.vertices[i] - primitive.first_vertex < primitive.vertex_count) {
            deltas[target.vertices[i] - primitive.first_vertex] = target.position_deltas[i];
        }
    }
    return deltas;
}

TEST(RealFiles, FacecapPlainHasItsHeadTargetsAndAnimation) {
    BLUSH_SHARED_OR_SKIP(path, "faces/facecap/facecap_plain.glb");
    const Result<Face> face = load_face(path);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_EQ(face->positions.size(), 4368U);
    EXPECT_EQ(face->targets.size(), 52U);
    EXPECT_EQ(face->targets[0].name, "browInnerUp");
    EXPECT_FLOAT_EQ(face->targets[0].default_weight, 0.12167F);
    ASSERT_EQ(face->primitives.size(), 4U);
    EXPECT_EQ(face->primitives[2].vertex_count, 2694U);
    EXPECT_EQ(face->primitives[2].normal_source, NormalSource::authored);
    EXPECT_EQ(face->primitives[0].normal_source, NormalSource::rest);
    ASSERT_EQ(face->images.size(), 1U);
    EXPECT_EQ(face->images[0].name, "FaceCapHeadGeneric");
    EXPECT_EQ(face->images[0].bytes.size(),
              std::size_t{face->images[0].width} * face->images[0].height * face->images[0].channels);
    ASSERT_EQ(face->animations.size(), 4U);
    ASSERT_EQ(face->animations[0].weights.size(), 1U);
    EXPECT_EQ(face->animations[0].weights[0].track.times_seconds.size(), 335U);
    EXPECT_NEAR(face->animations[0].duration_seconds, 11.18F, 0.05F);
    EXPECT_THAT(face->notes, IsEmpty());
}

TEST(RealFiles, CompressedFacecapAgreesWithThePlainOneWithinAThousandth) {
    BLUSH_SHARED_OR_SKIP(plain_path, "faces/facecap/facecap_plain.glb");
    BLUSH_SHARED_OR_SKIP(compressed_path, "faces/facecap/facecap.glb");
    const Result<Face> plain = load_face(plain_path), compressed = load_face(compressed_path);
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_TRUE(compressed) << compressed.error().message;
    ASSERT_EQ(compressed->positions.size(), plain->positions.size());
    ASSERT_EQ(compressed->targets.size(), plain->targets.size());
    float worst_position = 0, worst_delta = 0, worst_normal_cosine = 1;
    for (std::size_t p = 0; p < 4; ++p) {
        const Primitive& primitive = compressed->primitives[p];
        const auto mesh = static_cast<std::int32_t>(p);
        const glm::mat4 from_quantised = parent_from_node(node_of_mesh(*compressed, mesh));
        const glm::mat4 from_plain = parent_from_node(node_of_mesh(*plain, mesh));
        for (std::size_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
            worst_position =
                std::max(worst_position, glm::distance(from_quantised * glm::vec4(compressed->positions[v], 1),
                                                       from_plain * glm::vec4(plain->positions[v], 1)));
            worst_normal_cosine = std::min(worst_normal_cosine, glm::dot(glm::normalize(compressed->normals[v]),
                                                                         glm::normalize(plain->normals[v])));
        }
        for (std::size_t t = 0; t < plain->targets.size(); ++t) {
            EXPECT_EQ(compressed->targets[t].name, plain->targets[t].name);
            const auto a = dense(compressed->targets[t], primitive), b = dense(plain->targets[t], plain->primitives[p]);
            for (std::size_t v = 0; v < a.size(); ++v) {
                worst_delta = std::max(
                    worst_delta, glm::distance(from_quantised * glm::vec4(a[v], 0), from_plain * glm::vec4(b[v], 0)));
            }
        }
    }
    EXPECT_LE(worst_position, 1e-3F);
    EXPECT_LE(worst_delta, 1e-3F);
    EXPECT_GE(worst_normal_cosine, 0.999F);
    ASSERT_EQ(compressed->animations.size(), 4U);
    EXPECT_THAT(compressed->notes,
                ElementsAre("textures[0]: KHR_texture_basisu images cannot be decoded here, the material's "
                            "factor is used instead"));
    EXPECT_EQ(compressed->materials[0].base_color_srgb.image, -1);
}

TEST(RealFiles, SimpleMorph) {
    BLUSH_SHARED_OR_SKIP(path, "gltf/khronos/SimpleMorph/glTF/SimpleMorph.gltf");
    const Result<Face> face = load_face(path);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_THAT(face->positions, ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0.5F, 0.5F, 0)));
    EXPECT_THAT(face->indices, ElementsAre(0U, 1U, 2U));
    EXPECT_THAT(face->normals, ElementsAre(glm::vec3(0, 0, 1), glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)));
    ASSERT_EQ(face->targets.size(), 2U);
    EXPECT_EQ(face->targets[0].name, "target0");
    EXPECT_THAT(face->targets[0].vertices, ElementsAre(2U));
    EXPECT_THAT(face->targets[0].position_deltas, ElementsAre(glm::vec3(-1, 1, 0)));
    EXPECT_THAT(face->targets[0].normal_deltas, IsEmpty());
    EXPECT_THAT(face->targets[1].vertices, ElementsAre(2U));
    EXPECT_THAT(face->targets[1].position_deltas, ElementsAre(glm::vec3(1, 1, 0)));
    EXPECT_EQ(face->targets[1].default_weight, 0.5F);
    EXPECT_EQ(face->primitives[0].normal_source, NormalSource::recomputed);
    EXPECT_FALSE(face->primitives[0].authored_normals);
    ASSERT_EQ(face->animations.size(), 1U);
    const WeightChannel& channel = face->animations[0].weights[0];
    EXPECT_THAT(channel.track.times_seconds, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(channel.track.values, ElementsAre(0, 0, 0, 1, 1, 1, 1, 0, 0, 0));
}

TEST(RealFiles, SimpleSparseAccessor) {
    BLUSH_SHARED_OR_SKIP(path, "gltf/khronos/SimpleSparseAccessor/glTF/SimpleSparseAccessor.gltf");
    const Result<Face> face = load_face(path);
    ASSERT_TRUE(face) << face.error().message;
    ASSERT_EQ(face->positions.size(), 14U);
    // Two rows of seven; the sparse accessor lifts three vertices of the upper one.
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(face->positions[i], glm::vec3(i, 0, 0));
    const float upper[] = {1, 2, 1, 3, 1, 4, 1};
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(face->positions[7 + i], glm::vec3(i, upper[i], 0)) << i;
}

TEST(RealFiles, SparseMorphTargetOfTinygltf) {
    BLUSH_SHARED_OR_SKIP(path, "gltf/tinygltf/SparseMorphTargets-issue280/singleBlendshapeCube_sparse.glb");
    const Result<Face> face = load_face(path);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_EQ(face->positions.size(), 24U);
    ASSERT_EQ(face->targets.size(), 1U);
    const Target& target = face->targets[0];
    EXPECT_EQ(target.name, "blendShape1.pCube2");
    EXPECT_GT(target.vertices.size(), 0U);
    EXPECT_LT(target.vertices.size(), 24U);
    EXPECT_EQ(std::ranges::count(target.position_deltas, glm::vec3(0)), 0);
}

TEST(RealFiles, QuantisedMorphCubeAgreesWithThePlainOne) {
    BLUSH_SHARED_OR_SKIP(plain_path, "gltf/khronos/AnimatedMorphCube/glTF/AnimatedMorphCube.gltf");
    BLUSH_SHARED_OR_SKIP(quantised_path, "gltf/khronos/AnimatedMorphCube/glTF-Quantized/AnimatedMorphCube.gltf");
    const Result<Face> plain = load_face(plain_path), quantised = load_face(quantised_path);
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_TRUE(quantised) << quantised.error().message;
    EXPECT_TRUE(plain->primitives[0].authored_tangents);
    EXPECT_EQ(plain->primitives[0].normal_source, NormalSource::authored);
    // The plain cube's corners are at +-0.01; its first target moves corners by 0.01893253 along y.
    EXPECT_NEAR(plain->targets[0].position_deltas[0].y, 0.01893253F, 1e-7F);
    ASSERT_EQ(plain->positions.size(), 24U);
    ASSERT_EQ(quantised->positions.size(), 24U);
    // gltfpack reorders vertices, so each is sought by position, normal and deltas.
    const glm::mat4 from_quantised = parent_from_node(node_of_mesh(*quantised, 0));
    const glm::mat3 linear(from_quantised);
    const float step = quantised->nodes.back().rest.scale.x;
    EXPECT_GT(step, 0);
    std::vector<std::vector<glm::vec3>> a, b;
    for (std::size_t t = 0; t < 2; ++t) {
        a.push_back(dense(plain->targets[t], plain->primitives[0]));
        b.push_back(dense(quantised->targets[t], quantised->primitives[0]));
    }
    for (std::size_t v = 0; v < 24; ++v) {
        bool found = false;
        for (std::size_t w = 0; w < 24 && !found; ++w) {
            found = glm::distance(plain->positions[v],
                                  glm::vec3(from_quantised * glm::vec4(quantised->positions[w], 1))) < 1e-5F &&
                    glm::dot(plain->normals[v], quantised->normals[w]) > 0.99F &&
                    glm::distance(a[0][v], linear * b[0][w]) < 1e-5F &&
                    glm::distance(a[1][v], linear * b[1][w]) < 1e-5F;
        }
        EXPECT_TRUE(found) << "vertex " << v;
    }
    ASSERT_EQ(quantised->animations.size(), 1U);
    EXPECT_EQ(plain->animations[0].weights[0].track.times_seconds.size(), 127U);
    EXPECT_EQ(quantised->animations[0].weights[0].track.times_seconds.size(), 127U);
    // The quantised file's weights are normalised 8-bit integers.
    EXPECT_NEAR(*std::ranges::max_element(quantised->animations[0].weights[0].track.values), 1.0F, 1e-6F);
}

TEST(RealFiles, DracoMorphPrimitivesAgreeWithThePlainOnes) {
    BLUSH_SHARED_OR_SKIP(plain_path, "gltf/khronos/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf");
    BLUSH_SHARED_OR_SKIP(draco_path, "gltf/khronos/MorphPrimitivesTest/glTF-Draco/MorphPrimitivesTest.gltf");
    const Result<Face> plain = load_face(plain_path), draco = load_face(draco_path);
    ASSERT_TRUE(plain) << plain.error().message;
    ASSERT_TRUE(draco) << draco.error().message;
    for (const Face* face : {&*plain, &*draco}) {
        ASSERT_EQ(face->primitives.size(), 2U);
        EXPECT_EQ(face->primitives[0].vertex_count, 21U);
        EXPECT_EQ(face->primitives[1].vertex_count, 9U);
        EXPECT_EQ(face->primitives[1].first_vertex, 21U);
        EXPECT_EQ(face->primitives[0].index_count, 72U);
        ASSERT_EQ(face->targets.size(), 1U);
        EXPECT_EQ(face->targets[0].default_weight, 0.5F);
        // One target over both primitives.
        EXPECT_LT(face->targets[0].vertices.front(), 21U);
        EXPECT_GE(face->targets[0].vertices.back(), 21U);
        for (const glm::vec3& delta : face->targets[0].position_deltas) EXPECT_EQ(delta, glm::vec3(0, 0.2F, 0));
        EXPECT_EQ(face->images.size(), 1U);
    }
    // Draco reorders vertices and quantises them: each plain vertex has a twin nearby.
    for (const glm::vec3& p : plain->positions) {
        float nearest = 1;
        for (const glm::vec3& q : draco->positions) nearest = std::min(nearest, glm::distance(p, q));
        EXPECT_LT(nearest, 1e-3F);
    }
}

TEST(RealFiles, MorphStressTest) {
    BLUSH_SHARED_OR_SKIP(path, "gltf/khronos/MorphStressTest/glTF/MorphStressTest.gltf");
    BLUSH_SHARED_OR_SKIP(binary_path, "gltf/khronos/MorphStressTest/glTF-Binary/MorphStressTest.glb");
    const Result<Face> face = load_face(path), binary = load_face(binary_path);
    ASSERT_TRUE(face) << face.error().message;
    ASSERT_TRUE(binary) << binary.error().message;
    ASSERT_EQ(face->targets.size(), 8U);
    EXPECT_EQ(face->targets[7].name, "Key 8");
    ASSERT_EQ(face->primitives.size(), 2U);
    // The base plate has targets whose deltas are all zero.
    EXPECT_EQ(face->primitives[0].normal_source, NormalSource::rest);
    EXPECT_EQ(face->primitives[1].normal_source, NormalSource::authored);
    for (const Target& target : face->targets) EXPECT_GE(target.vertices.front(), face->primitives[1].first_vertex);
    ASSERT_EQ(face->animations.size(), 3U);
    EXPECT_EQ(face->animations[1].name, "TheWave");
    EXPECT_EQ(face->animations[1].weights[0].track.width, 8U);
    EXPECT_EQ(face->materials[0].occlusion.uv_set, 1U);
    EXPECT_EQ(face->images.size(), 3U);
    EXPECT_EQ(binary->positions, face->positions);
}

TEST(RealFiles, SimpleSkin) {
    BLUSH_SHARED_OR_SKIP(path, "gltf/khronos/SimpleSkin/glTF/SimpleSkin.gltf");
    const Result<Face> face = load_face(path);
    ASSERT_TRUE(face) << face.error().message;
    ASSERT_EQ(face->skins.size(), 1U);
    EXPECT_THAT(face->skins[0].joints, ElementsAre(1U, 2U));
    EXPECT_EQ(face->skins[0].joint_from_mesh[1][3], glm::vec4(0, -1, 0, 1));
    EXPECT_EQ(face->nodes[2].parent, 1);
    EXPECT_EQ(face->nodes[2].rest.translation, glm::vec3(0, 1, 0));
    ASSERT_EQ(face->joints.size(), 10U);
    // The bottom edge hangs on joint 0 alone, the top edge on joint 1, the middle on both.
    EXPECT_EQ(face->joints[2], glm::u16vec4(0, 1, 0, 0));
    EXPECT_EQ(face->joint_weights[0], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(face->joint_weights[2], glm::vec4(0.75F, 0.25F, 0, 0));
    EXPECT_EQ(face->joint_weights[9].x + face->joint_weights[9].y, 1.0F);
    ASSERT_EQ(face->animations[0].nodes.size(), 1U);
    EXPECT_EQ(face->animations[0].nodes[0].path, NodePath::rotation);
    EXPECT_EQ(face->animations[0].duration_seconds, 5.5F);
}

TEST(RealFiles, LeePerrySmithIsTheSameHeadInGlbAndObj) {
    BLUSH_SHARED_OR_SKIP(glb_path, "faces/lee-perry-smith/LeePerrySmith.glb");
    BLUSH_SHARED_OR_SKIP(obj_path, "faces/lee-perry-smith/LeePerrySmith.obj");
    const Result<Face> glb = load_face(glb_path), obj = load_face(obj_path);
    ASSERT_TRUE(glb) << glb.error().message;
    ASSERT_TRUE(obj) << obj.error().message;
    EXPECT_EQ(glb->positions.size(), 9279U);
    EXPECT_EQ(glb->indices.size(), 17684U * 3);
    EXPECT_EQ(obj->indices.size(), 17684U * 3);
    // The two are at different scales; their proportions agree.
    const auto width_by_height = [](const Face& face) {
        glm::vec3 low(1e9F), high(-1e9F);
        for (const glm::vec3& p : face.positions) low = glm::min(low, p), high = glm::max(high, p);
        return (high.x - low.x) / (high.y - low.y);
    };
    EXPECT_NEAR(width_by_height(*obj), 8.55264F / 7.945093F, 1e-3F);
    EXPECT_NEAR(width_by_height(*glb), 8.55264F / 7.945093F, 1e-5F);
}

TEST(RealFiles, MakehumanBaseKeepsTheNumbersOfItsVertices) {
    BLUSH_SHARED_OR_SKIP(path, "faces/makehuman/base.obj");
    const Result<Face> face = load_face(path);
    ASSERT_TRUE(face) << face.error().message;
    std::set<std::tuple<float, float, float>> distinct;
    for (const glm::vec3& p : face->positions) distinct.emplace(p.x, p.y, p.z);
    EXPECT_GE(face->positions.size(), 19158U);
    EXPECT_LE(distinct.size(), 19158U);
    EXPECT_GT(distinct.size(), 18000U);
}

TEST(RealFiles, EveryFaceAndSampleLoads) {
    BLUSH_SHARED_OR_SKIP(root, ".");
    std::size_t loaded = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".glb" && extension != ".gltf" && extension != ".obj") continue;
        // Hard cases, of which some are to be refused.
        if (std::filesystem::relative(entry.path(), root).lexically_normal().begin()->string() == "cases") continue;
        const Result<Face> face = load_face(entry.path());
        EXPECT_TRUE(face) << (face ? "" : face.error().message);
        ++loaded;
    }
    EXPECT_GE(loaded, 20U);
}

TEST(RealFiles, OtherFilesAreRefused) {
    for (const char* name : {"faces/ict-facekit/ict_expr.tar.xz", "faces/makehuman/caucasian-male-young.target",
                             "faces/makehuman/brown_eye.png", "performances/livelink/alex_rom_3.csv"}) {
        BLUSH_SHARED_OR_SKIP(path, name);
        const Result<Face> face = load_face(path);
        ASSERT_FALSE(face);
        EXPECT_EQ(face.error().message, path.string() + ": not a face file (expected .glb, .gltf or .obj)");
    }
}

}  // namespace
}  // namespace blush
