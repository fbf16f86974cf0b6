// What the loader makes of valid files, on files small enough to work out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "runtime/files/face_file.h"
#include "tests/load/compressed_glb.h"

namespace blush {
namespace {

using nlohmann::json;
using test::GlbBuilder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GltfRules : public testing::Test {
protected:
    Face load(const GlbBuilder& glb) {
        glb.write(folder_ / "face.glb");
        Result<Face> face = load_face(folder_ / "face.glb");
        EXPECT_TRUE(face) << (face ? "" : face.error().message);
        return face ? std::move(*face) : Face{};
    }
    static std::vector<std::string> names(const Face& face) {
        std::vector<std::string> result;
        for (const Target& target : face.targets) result.push_back(target.name);
        return result;
    }
    test::TemporaryFolder folder_;
};

GlbBuilder one_target() {
    GlbBuilder glb;
    glb.grid(1, 1).target("jawOpen", {1, 3}, {{0, -1, 0}, {0, -2, 0}});
    return glb;
}

/// Adds a second mesh with a node of its own that is a copy of the first.
void copy_mesh(GlbBuilder& glb) {
    const json mesh = glb.json["meshes"][0];
    glb.json["meshes"].push_back(mesh);
    glb.json["nodes"].push_back({{"mesh", 1}});
    glb.json["scenes"][0]["nodes"].push_back(1);
}

TEST_F(GltfRules, SparseTargetKeepsOnlyWhatMoves) {
    GlbBuilder glb = one_target();
    glb.dense_target("puff", {{0, 0, 0}, {0, 0, 0}, {0, 0, 3}, {0, 0, 0}},
                     {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    const Face face = load(glb);
    ASSERT_EQ(face.targets.size(), 2U);
    EXPECT_THAT(face.targets[0].vertices, ElementsAre(1U, 3U));
    EXPECT_THAT(face.targets[0].position_deltas, ElementsAre(glm::vec3(0, -1, 0), glm::vec3(0, -2, 0)));
    EXPECT_THAT(face.targets[0].normal_deltas, IsEmpty());
    // Vertex 0 has only a normal delta, vertex 2 only a position delta.
    EXPECT_THAT(face.targets[1].vertices, ElementsAre(0U, 2U));
    EXPECT_THAT(face.targets[1].position_deltas, ElementsAre(glm::vec3(0), glm::vec3(0, 0, 3)));
    EXPECT_THAT(face.targets[1].normal_deltas, ElementsAre(glm::vec3(1, 0, 0), glm::vec3(0)));
    // One target that moves has no NORMAL.
    EXPECT_EQ(face.primitives[0].normal_source, NormalSource::recomputed);
}

TEST_F(GltfRules, NormalSource) {
    GlbBuilder glb;
    glb.grid(1, 1);
    EXPECT_EQ(load(glb).primitives[0].normal_source, NormalSource::rest);
    GlbBuilder still = glb;
    still.dense_target("nothing", std::vector<glm::vec3>(4, glm::vec3(0)));
    EXPECT_EQ(load(still).primitives[0].normal_source, NormalSource::rest);
    EXPECT_EQ(load(still).targets.size(), 1U);
    GlbBuilder authored = glb;
    authored.target("puff", {1}, {{0, 0, 1}}, {{0, 1, 0}});
    EXPECT_EQ(load(authored).primitives[0].normal_source, NormalSource::authored);
    // A normal delta says nothing where the base normal is our own.
    authored.primitive()["attributes"].erase("NORMAL");
    EXPECT_EQ(load(authored).primitives[0].normal_source, NormalSource::recomputed);
}

TEST_F(GltfRules, TargetsOfOneNameInTwoMeshesAreOne) {
    GlbBuilder glb = one_target();
    copy_mesh(glb);
    glb.json["meshes"][1]["extras"]["targetNames"] = {"jawOpen"};
    const Face face = load(glb);
    EXPECT_THAT(names(face), ElementsAre("jawOpen"));
    EXPECT_THAT(face.targets[0].vertices, ElementsAre(1U, 3U, 5U, 7U));
    EXPECT_EQ(face.primitives[1].first_vertex, 4U);
    EXPECT_THAT(face.indices, ElementsAre(0U, 1U, 3U, 0U, 3U, 2U, 4U, 5U, 7U, 4U, 7U, 6U));
}

TEST_F(GltfRules, NormalDeltasOfALaterMeshStandBesideZeros) {
    GlbBuilder glb = one_target();
    copy_mesh(glb);
    glb.json["meshes"][1]["primitives"][0]["targets"][0]["NORMAL"] = glb.sparse_accessor({1}, {{1, 0, 0}});
    const Face face = load(glb);
    EXPECT_THAT(face.targets[0].normal_deltas,
                ElementsAre(glm::vec3(0), glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0)));
    EXPECT_EQ(face.primitives[0].normal_source, NormalSource::recomputed);
    EXPECT_EQ(face.primitives[1].normal_source, NormalSource::authored);
}

TEST_F(GltfRules, UnnamedTargets) {
    GlbBuilder glb = one_target();
    glb.json["meshes"][0].erase("extras");
    EXPECT_THAT(names(load(glb)), ElementsAre("target0"));
    copy_mesh(glb);
    glb.json["meshes"][0]["name"] = "head";
    EXPECT_THAT(names(load(glb)), ElementsAre("head.target0", "mesh1.target0"));
}

TEST_F(GltfRules, RepeatedNamesAreNumbered) {
    GlbBuilder glb = one_target();
    glb.target("jawOpen", {0}, {{1, 0, 0}}).target("jawOpen", {2}, {{1, 0, 0}});
    const Face face = load(glb);
    EXPECT_THAT(names(face), ElementsAre("jawOpen", "jawOpen#2", "jawOpen#3"));
    EXPECT_THAT(
        face.notes,
        ElementsAre("meshes[0].extras.targetNames: 2 names are used twice and were numbered, as in \"name#2\""));
}

TEST_F(GltfRules, DefaultWeightsComeFromTheNodeThenTheMesh) {
    GlbBuilder glb = one_target();
    EXPECT_EQ(load(glb).targets[0].default_weight, 0.0F);
    glb.json["meshes"][0]["weights"] = {0.25};
    EXPECT_EQ(load(glb).targets[0].default_weight, 0.25F);
    glb.json["nodes"][0]["weights"] = {0.75};
    EXPECT_EQ(load(glb).targets[0].default_weight, 0.75F);
}

TEST_F(GltfRules, StripsAndFansBecomeLists) {
    GlbBuilder glb;
    const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    glb.surface(corners, {0, 1, 2, 3, 4});
    glb.primitive()["mode"] = 5;
    EXPECT_THAT(load(glb).indices, ElementsAre(0U, 1U, 2U, 1U, 3U, 2U, 2U, 3U, 4U));
    glb.primitive()["mode"] = 6;
    EXPECT_THAT(load(glb).indices, ElementsAre(1U, 2U, 0U, 2U, 3U, 0U, 3U, 4U, 0U));
    glb.primitive()["mode"] = 1;
    const Face lines = load(glb);
    EXPECT_THAT(lines.indices, IsEmpty());
    EXPECT_EQ(lines.positions.size(), 5U);
    EXPECT_THAT(lines.notes, ElementsAre("meshes[0].primitives[0]: points and lines are not drawn"));
    glb.surface({corners.begin(), corners.begin() + 3}, {});
    glb.primitive().erase("indices");
    EXPECT_THAT(load(glb).indices, ElementsAre(0U, 1U, 2U));
}

TEST_F(GltfRules, NodesComeParentsFirst) {
    GlbBuilder glb = one_target();
    glb.json["nodes"] = {{{"mesh", 0}, {"name", "head"}},
                         {{"name", "root"}, {"children", {3}}},
                         {{"name", "other"}},
                         {{"name", "neck"}, {"children", {0}}}};
    glb.json["scenes"][0]["nodes"] = {1};
    glb.node_animation("translation", {0}, std::vector<glm::vec3>{{0, 1, 0}});
    const Face face = load(glb);
    std::vector<std::string> order;
    for (const Node& node : face.nodes) order.push_back(node.name);
    EXPECT_THAT(order, ElementsAre("root", "other", "neck", "head"));
    EXPECT_EQ(face.nodes[3].parent, 2);
    EXPECT_EQ(face.nodes[2].parent, 0);
    EXPECT_EQ(face.nodes[3].file_index, 0U);
    EXPECT_EQ(face.animations[0].nodes[0].node, 3U);
}

TEST_F(GltfRules, ChainOfAHundredThousandNodes) {
    GlbBuilder glb = one_target();
    constexpr int count = 100'000;
    json nodes = json::array();
    for (int i = 0; i < count; ++i) nodes.push_back(i == 0 ? json{{"mesh", 0}} : json{{"children", {i - 1}}});
    glb.json["nodes"] = std::move(nodes);
    glb.json["scenes"][0]["nodes"] = {count - 1};
    const Face face = load(glb);
    ASSERT_EQ(face.nodes.size(), 100'000U);
    EXPECT_EQ(face.nodes.back().mesh, 0);
    EXPECT_EQ(face.nodes.back().file_index, 0U);
}

TEST_F(GltfRules, NodesOutsideTheSceneAreNotDrawn) {
    GlbBuilder glb = one_target();
    copy_mesh(glb);
    glb.json["scenes"][0]["nodes"] = {0};
    const Face face = load(glb);
    EXPECT_EQ(face.nodes[1].mesh, -1);
    EXPECT_THAT(face.notes, ElementsAre("1 nodes with a mesh are outside the file's scene and are not drawn"));
}

TEST_F(GltfRules, MatrixAndTransform) {
    GlbBuilder glb = one_target();
    glb.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
    const Face face = load(glb);
    ASSERT_TRUE(face.nodes[0].matrix);
    EXPECT_EQ((*face.nodes[0].matrix)[3], glm::vec4(5, 6, 7, 1));
    glb.json["nodes"][0] = {{"mesh", 0}, {"rotation", {0, 0, 2, 0}}, {"scale", {1, 2, 3}}};
    const Face turned = load(glb);
    EXPECT_FALSE(turned.nodes[0].matrix);
    EXPECT_EQ(turned.nodes[0].rest.rotation, (Quat{0, 0, 0, 1}));
    EXPECT_EQ(turned.nodes[0].rest.scale, glm::vec3(1, 2, 3));
}

TEST_F(GltfRules, WeightsOfASecondInstanceAreLeftOut) {
    GlbBuilder glb = one_target();
    glb.weight_animation({0, 2}, {0, 1});
    glb.json["nodes"].push_back({{"mesh", 0}});
    glb.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(load(glb).animations[0].weights.size(), 1U);
    EXPECT_EQ(load(glb).animations[0].duration_seconds, 2.0F);
    glb.json["animations"][0]["channels"][0]["target"]["node"] = 1;
    const Face face = load(glb);
    EXPECT_THAT(face.animations[0].weights, IsEmpty());
    EXPECT_THAT(face.notes,
                ElementsAre("animations[0].channels[0]: it animates a second instance of meshes[0] and was left out"));
}

TEST_F(GltfRules, NormalisedIntegers) {
    GlbBuilder glb = one_target();
    glb.primitive()["attributes"]["TEXCOORD_0"] =
        glb.accessor(std::vector<glm::u16vec2>{{0, 65535}, {65535, 0}, {0, 0}, {13107, 0}}, "VEC2", 5123);
    glb.json["accessors"].back()["normalized"] = true;
    // -128 clamps at -1 (glTF 2.0, 3.11).
    const std::vector<glm::i8vec4> normals = {{-128, 0, 0, 0}, {0, 127, 0, 0}, {0, 0, 127, 0}, {0, 0, -127, 0}};
    glb.json["accessors"].push_back({{"bufferView", glb.view(std::as_bytes(std::span(normals)))},
                                     {"componentType", 5120},
                                     {"count", 4},
                                     {"type", "VEC3"},
                                     {"normalized", true}});
    glb.json["bufferViews"].back()["byteStride"] = 4;
    glb.primitive()["attributes"]["NORMAL"] = glb.json["accessors"].size() - 1;
    const Face face = load(glb);
    EXPECT_EQ(face.uv0[0], glm::vec2(0, 1));
    EXPECT_NEAR(face.uv0[3].x, 0.2F, 1e-6F);
    EXPECT_THAT(face.normals,
                ElementsAre(glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)));
}

TEST_F(GltfRules, NormalsWithoutLengthAreComputed) {
    GlbBuilder glb = one_target();
    glb.attribute("NORMAL", std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}});
    const Face face = load(glb);
    EXPECT_EQ(face.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(face.normals[1], glm::vec3(1, 0, 0));
    EXPECT_THAT(
        face.notes,
        ElementsAre("meshes[0].primitives[0].attributes.NORMAL: 1 normals have no length and were computed from "
                    "the triangles"));
}

TEST_F(GltfRules, TangentsFollowTheTextureCoordinates) {
    const Face face = load(one_target());
    EXPECT_FALSE(face.primitives[0].authored_tangents);
    // On this grid u runs along x and v along -y: the texture reads rightly from outside, and its green points up.
    for (const glm::vec4& tangent : face.tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
}

TEST_F(GltfRules, JointWeightsSumToOne) {
    GlbBuilder glb = one_target();
    glb.attribute("WEIGHTS_0", std::vector<glm::vec4>{{1, 1, 0, 0}, {0, 0, 0, 0}, {0.5F, 0, 0, 0}, {3, 0, 0, 1}});
    glb.primitive()["attributes"]["JOINTS_0"] =
        glb.accessor(std::vector<glm::u8vec4>(4, glm::u8vec4(0, 1, 9, 0)), "VEC4", 5121);
    glb.json["nodes"][0]["skin"] = 0;
    glb.json["nodes"].push_back({{"name", "a"}});
    glb.json["skins"] = {{{"joints", {1, 1}}}};
    const Face face = load(glb);
    EXPECT_THAT(face.joint_weights, ElementsAre(glm::vec4(0.5F, 0.5F, 0, 0), glm::vec4(0), glm::vec4(1, 0, 0, 0),
                                                glm::vec4(0.75F, 0, 0, 0.25F)));
    EXPECT_EQ(face.skins[0].joint_from_mesh[1], glm::mat4(1));
}

TEST_F(GltfRules, TextureTransformAndWrapping) {
    // KHR_texture_transform's own example: the lower left quadrant of the image, turned by 90 degrees.
    GlbBuilder glb = one_target();
    glb.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
    glb.json["samplers"] = {{{"wrapS", 33071}}};
    // One white pixel.
    glb.json["images"] = {{{"uri",
                            "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8/"
                            "5+hHgAHggJ/PchI7wAAAABJRU5ErkJggg=="}}};
    glb.json["materials"] = {
        {{"emissiveTexture",
          {{"index", 0},
           {"extensions",
            {{"KHR_texture_transform",
              {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}, {"texCoord", 1}}}}}}}}};
    glb.primitive()["material"] = 0;
    const Face face = load(glb);
    const TextureUse& use = face.materials[0].emissive_srgb;
    EXPECT_EQ(use.image, 0);
    EXPECT_EQ(use.uv_set, 1U);
    EXPECT_FALSE(use.repeat_u);
    EXPECT_TRUE(use.repeat_v);
    for (const glm::vec2 uv : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(1, 1)}) {
        const glm::vec3 moved = use.uv_transform * glm::vec3(uv, 1);
        EXPECT_NEAR(moved.x, 0.5F * uv.y, 1e-6F);
        EXPECT_NEAR(moved.y, 1 - 0.5F * uv.x, 1e-6F);
    }
    ASSERT_EQ(face.images.size(), 1U);
    EXPECT_EQ(face.images[0].channels, 4U);
    EXPECT_EQ(face.images[0].bytes.size(), 4U);
    LoadLimits tiny;
    tiny.image_side_pixels = 0;
    const Result<Face> refused = load_face(folder_ / "face.glb", tiny);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("images[0]: the image is 1x1 pixels; a side may have 0"));
}

TEST_F(GltfRules, MeshoptModesGiveBackTheSameMesh) {
    GlbBuilder glb;
    glb.grid(8, 8).target("jawOpen", {1, 3}, {{0, -1, 0}, {0, -2, 0}});
    const Face plain = load(glb);
    for (const char* mode : {"TRIANGLES", "INDICES"}) {
        GlbBuilder compressed = glb;
        test::compress_view(compressed, 0, 12, "ATTRIBUTES");
        test::compress_view(compressed, 1, 4, mode);
        const Face face = load(compressed);
        EXPECT_EQ(face.positions, plain.positions);
        ASSERT_EQ(face.indices.size(), plain.indices.size());
        // The triangle codec may turn a triangle's corners round.
        for (std::size_t i = 0; i < face.indices.size(); i += 3) {
            const auto lowest = [](const Face& f, std::size_t t) {
                return std::min({f.indices[t], f.indices[t + 1], f.indices[t + 2]});
            };
            EXPECT_EQ(lowest(face, i), lowest(plain, i));
        }
    }
}

TEST_F(GltfRules, MeshoptOctahedralFilter) {
    GlbBuilder glb;
    glb.grid(1, 1);
    const std::vector<float> directions = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0.6F, 0, 0.8F, 0};
    std::vector<std::int8_t> packed(16);
    meshopt_encodeFilterOct(packed.data(), 4, 4, 8, directions.data());
    glb.primitive()["attributes"]["NORMAL"] = glb.accessor(packed, "SCALAR", 5120);
    json& accessor = glb.json["accessors"].back();
    accessor["type"] = "VEC3", accessor["count"] = 4, accessor["normalized"] = true;
    const std::size_t index = glb.json["accessors"].size() - 1;
    test::compress_view(glb, index, 4, "ATTRIBUTES", "OCTAHEDRAL");
    const Face face = load(glb);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 direction(directions[4 * i], directions[4 * i + 1], directions[4 * i + 2]);
        EXPECT_GT(glm::dot(face.normals[i], direction), 0.999F) << i;
    }
}

TEST_F(GltfRules, DracoFan) {
    const Face face = load(test::draco_fan(12));
    EXPECT_EQ(face.positions.size(), 13U);
    EXPECT_EQ(face.indices.size(), 36U);
    for (const glm::vec3& p : face.positions) {
        const float radius = glm::length(p);
        EXPECT_TRUE(std::abs(radius - 1) < 1e-3F || radius < 1e-3F) << radius;
    }
    for (const glm::vec3& n : face.normals) EXPECT_NEAR(n.z, 1, 1e-5F);
}

/// `count` sparse targets of three vertices each over a grid of `side` x `side` quads.
GlbBuilder many_targets(std::uint32_t count, std::uint32_t side) {
    GlbBuilder glb;
    glb.grid(side, side);
    const std::uint32_t vertices = (side + 1) * (side + 1);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t v = i % (vertices - 2);
        glb.target("t" + std::to_string(i), {v, v + 1, v + 2}, std::vector<glm::vec3>(3, {0, 0, 1}));
    }
    return glb;
}

TEST_F(GltfRules, TwoHundredFiftySevenAndEightThousandTargets) {
    for (const std::uint32_t count : {257U, 8192U}) {
        many_targets(count, 100).write(folder_ / "many.glb");
        const auto start = std::chrono::steady_clock::now();
        const Result<Face> face = load_face(folder_ / "many.glb");
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        ASSERT_TRUE(face) << face.error().message;
        ASSERT_EQ(face->targets.size(), count);
        EXPECT_EQ(face->targets.back().vertices.size(), 3U);
        EXPECT_EQ(face->targets.back().name, "t" + std::to_string(count - 1));
        // Generous: sanitizers and shared machines are slow.
        EXPECT_LT(elapsed.count(), 10.0);
        RecordProperty("load_seconds_" + std::to_string(count), std::to_string(elapsed.count()));
    }
}

TEST_F(GltfRules, ObjSplitsVerticesAtSeamsAndKeepsTheirOrder) {
    const auto load_text = [&](const std::string& text) {
        GlbBuilder::write_file(folder_ / "a.obj", std::vector<std::uint8_t>(text.begin(), text.end()));
        Result<Face> face = load_face(folder_ / "a.obj");
        EXPECT_TRUE(face) << (face ? "" : face.error().message);
        return face ? std::move(*face) : Face{};
    };
    // A quad and a triangle that meet at an edge; vertex 2 has two texture coordinates.
    const std::string shape =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 9 9 9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n";
    const Face seam = load_text(shape + "f 1/1 2/2 3/3 4/4\nf 2/5 5/2 3/3\n");
    ASSERT_EQ(seam.positions.size(), 7U);
    EXPECT_EQ(seam.positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(seam.positions[2], glm::vec3(1, 0, 0));
    EXPECT_EQ(seam.positions[6], glm::vec3(9, 9, 9));
    EXPECT_EQ(seam.uv0[0], glm::vec2(0, 1));
    EXPECT_EQ(seam.indices.size(), 9U);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(seam.normals[i], glm::vec3(0, 0, 1)) << i;
    // Without texture coordinates vertex i is the file's.
    const Face plain = load_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    EXPECT_THAT(plain.indices, ElementsAre(0U, 1U, 2U, 0U, 2U, 3U));
    const Face groups = load_text(shape + "usemtl skin\nf 1 2 3 4\nusemtl eye\nf 2 5 3\n");
    ASSERT_EQ(groups.primitives.size(), 2U);
    EXPECT_EQ(groups.materials[1].name, "eye");
    EXPECT_EQ(groups.primitives[1].first_vertex, 5U);
    EXPECT_EQ(groups.primitives[1].vertex_count, 3U);
    // Three faces at one edge are not a manifold; all of them stay.
    const Face fin = load_text(shape + "f 1 2 3\nf 1 2 4\nf 1 2 5\n");
    EXPECT_EQ(fin.indices.size(), 9U);
    EXPECT_EQ(fin.positions.size(), 6U);
    const Face thin = load_text(shape + "f 1 2 3\nf 1 2 2\n");
    EXPECT_THAT(thin.notes, ElementsAre("1 faces have fewer than three different corners and were left out"));
}

}  // namespace
}  // namespace blush
