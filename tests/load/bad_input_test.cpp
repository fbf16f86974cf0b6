// One sentence for every kind of bad file. The part after the path is compared word for word.
#include <gtest/gtest.h>

#include <limits>

#include "runtime/files/face_file.h"
#include "tests/gltf_builder.h"

namespace blush {
namespace {

using nlohmann::json;
using test::GlbBuilder;

class BadInput : public testing::Test {
protected:
    std::string error_of_file(const std::string& name, std::span<const std::uint8_t> content) {
        const auto path = folder_ / name;
        GlbBuilder::write_file(path, content);
        return error_at(path);
    }
    std::string error_of_text(const std::string& name, const std::string& text) {
        return error_of_file(name, std::vector<std::uint8_t>(text.begin(), text.end()));
    }
    std::string error_of(const GlbBuilder& glb) { return error_of_file("face.glb", glb.bytes()); }
    std::string error_at(const std::filesystem::path& path, const LoadLimits& limits = {}) {
        const Result<Face> face = load_face(path, limits);
        if (face) return "(it loaded)";
        const std::string prefix = path.string() + ": ";
        EXPECT_TRUE(face.error().message.starts_with(prefix)) << face.error().message;
        return face.error().message.substr(std::min(prefix.size(), face.error().message.size()));
    }

    /// Four vertices, two triangles, one target: accessors 0 POSITION, 1 indices, 2 NORMAL, 3 uv, 4 target.
    static GlbBuilder good() {
        GlbBuilder glb;
        glb.grid(1, 1).target("jawOpen", {0, 1}, {{0, -1, 0}, {0, -1, 0}});
        return glb;
    }
    static void poke(GlbBuilder& glb, std::size_t accessor, std::size_t number, float value) {
        const std::size_t view = glb.json["accessors"][accessor]["bufferView"].get<std::size_t>();
        const std::size_t offset = glb.json["bufferViews"][view]["byteOffset"].get<std::size_t>();
        std::memcpy(glb.bin.data() + offset + 4 * number, &value, sizeof value);
    }

    test::TemporaryFolder folder_;
};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST_F(BadInput, TheGoodFileLoads) { EXPECT_EQ(error_of(good()), "(it loaded)"); }

TEST_F(BadInput, NotAFaceFile) {
    EXPECT_EQ(error_at(folder_ / "missing.glb"), "there is no such file");
    EXPECT_EQ(error_at(folder_ / ""), "this is a folder, not a file");
    EXPECT_EQ(error_at("/dev/zero"), "this is not a regular file");
    EXPECT_EQ(error_of_text("empty.glb", ""), "not a face file: it is empty (expected .glb, .gltf or .obj)");
    EXPECT_EQ(error_of_text("a.csv", "Timecode,BlendshapeCount"), "not a face file (expected .glb, .gltf or .obj)");
    EXPECT_EQ(error_of_text("a.json", "{}"), "not a face file (expected .glb, .gltf or .obj)");
    EXPECT_EQ(error_of_text("a.glb", "\x89PNG"),
              "not a face file: it is named .glb, but its content is neither GLB nor JSON");
}

TEST_F(BadInput, GlbUnderAnotherNameIsKnownByItsContent) {
    EXPECT_EQ(error_of_file("face.bin", good().bytes()), "(it loaded)");
    EXPECT_EQ(error_of_file("face.gltf", good().bytes()), "(it loaded)");
    EXPECT_EQ(error_of_file("FACE.GLB", good().bytes()), "(it loaded)");
}

TEST_F(BadInput, FileLargerThanTheLimit) {
    good().write(folder_ / "face.glb");
    const auto size = std::filesystem::file_size(folder_ / "face.glb");
    EXPECT_EQ(error_at(folder_ / "face.glb", {.file_bytes = 100}),
              "the file has " + std::to_string(size) + " bytes; at most 100 are read");
}

TEST_F(BadInput, GlbShell) {
    std::vector<std::uint8_t> file = good().bytes();
    file[4] = 1;
    EXPECT_EQ(error_of_file("a.glb", file), "GLB version 1 is not understood, only 2 is");
    file = good().bytes();
    const std::size_t size = file.size();
    file.resize(size - 1);
    EXPECT_EQ(error_of_file("a.glb", file),
              "the GLB header says " + std::to_string(size) + " bytes, but the file has " + std::to_string(size - 1));
    file = good().bytes();
    file[15] = 0x7F;
    EXPECT_TRUE(error_of_file("a.glb", file).starts_with("chunk 0: it says 213")) << error_of_file("a.glb", file);
    file = good().bytes();
    file[16] = 'X';
    EXPECT_EQ(error_of_file("a.glb", file), "chunk 0: the first chunk of a GLB must be JSON");
}

TEST_F(BadInput, EveryTruncatedLengthIsAnError) {
    const std::vector<std::uint8_t> file = good().bytes();
    for (std::size_t length = 0; length < file.size(); ++length) {
        const std::string error = error_of_file("cut.glb", std::span(file).first(length));
        EXPECT_NE(error, "(it loaded)") << length;
        // The same bytes with a header that agrees: the JSON or the buffer is what is short now.
        if (length < 12) continue;
        std::vector<std::uint8_t> patched(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
        for (unsigned i = 0; i < 4; ++i) patched[8 + i] = static_cast<std::uint8_t>(length >> (8 * i));
        EXPECT_NE(error_of_file("cut.glb", patched), "(it loaded)") << length;
    }
}

TEST_F(BadInput, Json) {
    EXPECT_EQ(error_of_text("a.gltf", "{\"asset\": "), "the JSON cannot be parsed (at byte 11)");
    EXPECT_EQ(error_of_text("a.gltf", "{\"asset\": {\"version\": \"2.0\"}}"), "the file has no mesh with vertices");
    EXPECT_EQ(error_of_text("a.gltf", "{}"), "asset: is missing");
    EXPECT_EQ(error_of_text("a.gltf", "{\"asset\": 3}"), "asset: must be an object");
    EXPECT_EQ(error_of_text("a.gltf", "{\"asset\": {\"version\": 2}}"), "asset.version: must be a string");
    EXPECT_EQ(error_of_text("deep.gltf", "{\"extras\": " + std::string(100'000, '[')),
              "the JSON is nested deeper than 64 levels");
}

TEST_F(BadInput, ByteOrderMarkIsAccepted) {
    GlbBuilder glb = good();
    const std::string base64 = "data:application/octet-stream;base64,";
    glb.json["buffers"] = {{{"byteLength", 1}, {"uri", base64 + "AA=="}}};
    // The buffer is too short on purpose: the message shows that the JSON was read past the mark.
    EXPECT_EQ(error_of_text("mark.gltf", "\xEF\xBB\xBF" + glb.json.dump()),
              "bufferViews[0]: bytes 0 to 48 are beyond the 1 bytes of buffers[0]");
}

TEST_F(BadInput, WrongTypesAndIndices) {
    GlbBuilder glb = good();
    glb.json["accessors"][0]["count"] = "four";
    EXPECT_EQ(error_of(glb), "accessors[0].count: must be a whole number from 0");
    glb = good();
    glb.json["accessors"][0]["count"] = -1;
    EXPECT_EQ(error_of(glb), "accessors[0].count: must be a whole number from 0");
    glb = good();
    glb.primitive()["indices"] = 99;
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].indices: there is no accessors[99], the file has 5 accessors");
    glb = good();
    glb.json["meshes"] = 4;
    EXPECT_EQ(error_of(glb), "meshes: must be an array");
    glb = good();
    glb.json["nodes"][0]["mesh"] = 1;
    EXPECT_EQ(error_of(glb), "nodes[0].mesh: there is no meshes[1], the file has 1 meshes");
    glb = good();
    glb.json["nodes"][0]["translation"] = {1, 2};
    EXPECT_EQ(error_of(glb), "nodes[0].translation: must have 3 numbers, it has 2");
    glb = good();
    glb.json["nodes"][0]["scale"] = {1, 2, 1e300};
    EXPECT_EQ(error_of(glb), "nodes[0].scale[2]: is beyond the range of a float");
    glb = good();
    glb.primitive().erase("attributes");
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].attributes: is missing");
}

TEST_F(BadInput, RequiredExtensions) {
    GlbBuilder glb = good();
    glb.json["extensionsRequired"] = {"KHR_materials_unlit"};
    EXPECT_EQ(
        error_of(glb),
        "extensionsRequired[0]: the file requires the extension \"KHR_materials_unlit\", which is not understood");
    glb = good();
    glb.json["extensionsUsed"] = {"KHR_materials_unlit"};
    glb.write(folder_ / "face.glb");
    const Result<Face> face = load_face(folder_ / "face.glb");
    ASSERT_TRUE(face);
    EXPECT_EQ(face->notes, std::vector<std::string>{
                               "the optional extension \"KHR_materials_unlit\" is not understood and was left out"});
}

TEST_F(BadInput, BuffersAndViews) {
    GlbBuilder glb = good();
    glb.json["buffers"] = {{{"byteLength", glb.bin.size() + 100}}};
    EXPECT_EQ(error_of(glb), "buffers[0]: byteLength is " + std::to_string(glb.bin.size() + 100) +
                                 ", but there are only " + std::to_string(glb.bin.size()) + " bytes");
    glb = good();
    glb.json["buffers"] = {{{"byteLength", 10}, {"uri", "gone.bin"}}};
    EXPECT_EQ(error_of(glb), "buffers[0].uri (\"gone.bin\"): there is no such file");
    glb.json["buffers"] = {{{"byteLength", 10}, {"uri", "https://example.org/a.bin"}}};
    EXPECT_EQ(error_of(glb), "buffers[0].uri: \"https://example.org/a.bin\" is not a file beside this one");
    glb.json["buffers"] = {{{"byteLength", 10}, {"uri", "data:application/octet-stream;base64,A!=="}}};
    EXPECT_EQ(error_of(glb), "buffers[0].uri: the base64 text has a character that does not belong to it");
    glb = good();
    glb.json["bufferViews"][0]["byteOffset"] = 2'000'000'000;
    EXPECT_EQ(error_of(glb), "bufferViews[0]: bytes 2000000000 to 2000000048 are beyond the " +
                                 std::to_string(glb.bin.size()) + " bytes of buffers[0]");
    glb = good();
    glb.json["bufferViews"][0]["byteStride"] = 6;
    EXPECT_EQ(error_of(glb), "bufferViews[0].byteStride: 6 is not a multiple of 4 up to 252");
    glb = good();
    glb.json["bufferViews"][0]["byteStride"] = 8;
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].attributes.POSITION (accessors[0]): elements of 12 bytes do not fit a "
              "byteStride of 8");
}

TEST_F(BadInput, ABillionVerticesByHeaderAlone) {
    GlbBuilder glb = good();
    glb.json["accessors"][0]["count"] = 1'000'000'000;
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].attributes.POSITION: the file has more than 64000000 vertices");
    glb.json["accessors"][0]["count"] = 50'000'000;
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].attributes.POSITION (accessors[0]): 50000000 elements of 12 bytes from byte 0 "
              "on do not "
              "fit the 48 bytes of bufferViews[0]");
    glb.json["accessors"][0].erase("bufferView");
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].attributes.POSITION (accessors[0]): it has no bufferView and says 50000000 "
              "elements; at "
              "most 1000000 are allowed without data");
}

TEST_F(BadInput, OneAccessorNamedAThousandTimes) {
    GlbBuilder glb;
    glb.grid(100, 100);
    const json primitive = glb.primitive();
    for (int i = 0; i < 1000; ++i) glb.json["meshes"][0]["primitives"].push_back(primitive);
    EXPECT_TRUE(error_of(glb).ends_with("the file names more elements than its bytes can hold")) << error_of(glb);
}

TEST_F(BadInput, NotFinite) {
    GlbBuilder glb = good();
    poke(glb, 0, 4, nan);
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].attributes.POSITION: element 1 is not a finite number");
    glb = good();
    poke(glb, 2, 3, infinity);
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].attributes.NORMAL: element 1 is not a finite number");
    glb = good();
    glb.dense_target("puff", {{0, 0, 0}, {0, nan, 0}, {0, 0, 0}, {0, 0, 0}});
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].targets[1].POSITION: element 1 is not a finite number");
    glb = good();
    glb.weight_animation({0, 1}, {0, infinity});
    EXPECT_EQ(error_of(glb), "animations[0].samplers[0].output: element 1 is not a finite number");
    glb = good();
    glb.weight_animation({0, nan}, {0, 1});
    EXPECT_EQ(error_of(glb), "animations[0].samplers[0].input: element 1 is not a finite number");
}

TEST_F(BadInput, Indices) {
    GlbBuilder glb = good();
    poke(glb, 1, 5, 1.0F);
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].indices: index 5 is 1065353216, but the primitive has 4 vertices");
    glb = good();
    glb.json["accessors"][1]["count"] = 5;
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].indices: 5 indices do not make triangles");
    glb = good();
    glb.json["accessors"][1]["componentType"] = 5126;
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].indices (accessors[1]): its components are not unsigned integers");
    glb = good();
    glb.primitive()["mode"] = 9;
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].mode: 9 is not a mode of glTF");
}

TEST_F(BadInput, Targets) {
    GlbBuilder glb = good();
    glb.dense_target("puff", {{0, 0, 0}, {0, 1, 0}});
    EXPECT_EQ(error_of(glb), "meshes[0].primitives[0].targets[1].POSITION: it has 2 elements, but 4 are needed");
    glb = good();
    glb.target("puff", {1, 1}, {{0, 1, 0}, {0, 1, 0}});
    EXPECT_EQ(
        error_of(glb),
        "meshes[0].primitives[0].targets[1].POSITION (accessors[5]).sparse.indices: they are not strictly ascending");
    glb = good();
    glb.target("puff", {1, 4}, {{0, 1, 0}, {0, 1, 0}});
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].targets[1].POSITION (accessors[5]).sparse.indices: element 1 is 4, but the "
              "accessor has 4 elements");
    glb = good();
    glb.json["accessors"][4]["sparse"]["count"] = 2'000'000'000;
    EXPECT_EQ(
        error_of(glb),
        "meshes[0].primitives[0].targets[0].POSITION (accessors[4]).sparse: it replaces 2000000000 elements of 4");
    glb = good();
    glb.json["accessors"][4]["type"] = "VEC2";
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].targets[0].POSITION (accessors[4]): its type has 2 components, 3 are needed");
    glb = good();
    json second = glb.primitive();
    second["targets"].push_back(second["targets"][0]);
    glb.json["meshes"][0]["primitives"].push_back(second);
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].targets: it has 1 targets, but another primitive of the mesh has 2");
    glb = good();
    glb.write(folder_ / "face.glb");
    EXPECT_EQ(error_at(folder_ / "face.glb", {.targets = 0}), "meshes[0]: the file has more than 0 targets");
}

TEST_F(BadInput, Nodes) {
    GlbBuilder glb = good();
    glb.json["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}};
    EXPECT_EQ(error_of(glb), "nodes[2].children[0]: nodes[1] already is a child of nodes[0]");
    glb.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
    EXPECT_EQ(error_of(glb), "nodes[1]: it is its own ancestor");
    glb.json["nodes"] = {{{"mesh", 0}, {"children", {0}}}};
    EXPECT_EQ(error_of(glb), "nodes[0]: it is its own ancestor");
    glb.json["nodes"] = {{{"mesh", 0}, {"rotation", {0, 0, 0, 0}}}};
    EXPECT_EQ(error_of(glb), "nodes[0].rotation: it has length zero");
}

TEST_F(BadInput, Skins) {
    GlbBuilder glb = good();
    glb.attribute("WEIGHTS_0", std::vector<glm::vec4>(4, glm::vec4(1, 0, 0, 0)));
    glb.primitive()["attributes"]["JOINTS_0"] =
        glb.accessor(std::vector<glm::u16vec4>(4, glm::u16vec4(2, 0, 0, 0)), "VEC4", 5123);
    glb.json["nodes"][0]["skin"] = 0;
    glb.json["nodes"].push_back({{"name", "joint"}});
    glb.json["skins"] = {{{"joints", {1}}}};
    EXPECT_EQ(error_of(glb),
              "meshes[0].primitives[0].attributes.JOINTS_0: vertex 0 names joint 2, but the skin of nodes[0] has 1");
    glb.json["skins"] = {{{"joints", {7}}}};
    EXPECT_EQ(error_of(glb), "skins[0].joints[0]: there is no nodes[7], the file has 2 nodes");
    glb.json["skins"] = {{{"joints", {1, 1, 1}},
                          {"inverseBindMatrices", glb.accessor(std::vector<glm::mat4>(2, glm::mat4(1)), "MAT4")}}};
    EXPECT_EQ(error_of(glb), "skins[0].inverseBindMatrices: it has 2 elements, but 3 are needed");
    glb.json["skins"] = {{{"joints", {1, 1, 1}},
                          {"inverseBindMatrices", glb.accessor(std::vector<glm::mat4>(3, glm::mat4(nan)), "MAT4")}}};
    EXPECT_EQ(error_of(glb), "skins[0].inverseBindMatrices: element 0 is not a finite number");
}

TEST_F(BadInput, Animations) {
    GlbBuilder glb = good();
    glb.weight_animation({0, 1, 1}, {0, 1, 0});
    EXPECT_EQ(error_of(glb), "animations[0].samplers[0].input: key 2 is not later than the key before it");
    glb = good();
    glb.weight_animation({0, 1}, {0, 1, 0});
    EXPECT_EQ(error_of(glb), "animations[0].samplers[0].output: it has 3 elements, but 2 are needed");
    glb = good();
    glb.weight_animation({0, 1}, {0, 1}, "CUBICSPLINE");
    EXPECT_EQ(error_of(glb), "animations[0].samplers[0].output: it has 2 elements, but 6 are needed");
    glb = good();
    glb.weight_animation({0, 1}, {0, 1}, "QUINTIC");
    EXPECT_EQ(error_of(glb), "animations[0].samplers[0].interpolation: \"QUINTIC\" is not STEP, LINEAR or CUBICSPLINE");
    glb = good();
    glb.node_animation("rotation", {0}, std::vector<glm::vec4>{glm::vec4(0)});
    EXPECT_EQ(error_of(glb), "animations[0].samplers[0].output: key 0 is a rotation of length zero");
    glb = good();
    glb.weight_animation({0}, {0});
    glb.json["animations"][0]["channels"][0]["sampler"] = 3;
    EXPECT_EQ(error_of(glb), "animations[0].channels[0].sampler: there is no samplers[3], the animation has 1");
}

TEST_F(BadInput, Images) {
    GlbBuilder glb = good();
    glb.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    glb.json["textures"] = {{{"source", 0}}};
    glb.json["images"] = {{{"uri", "gone.png"}}};
    glb.primitive()["material"] = 0;
    EXPECT_EQ(error_of(glb), "images[0].uri (\"gone.png\"): there is no such file");
    GlbBuilder::write_file(folder_ / "bad.png", std::vector<std::uint8_t>{1, 2, 3});
    glb.json["images"] = {{{"uri", "bad.png"}}};
    EXPECT_EQ(error_of(glb), "images[0]: the image is not PNG, JPEG, WebP, HDR or EXR");
    const std::string cut = "\x89PNG\r\n\x1A\n";
    GlbBuilder::write_file(folder_ / "cut.png", std::vector<std::uint8_t>(cut.begin(), cut.end()));
    glb.json["images"] = {{{"uri", "cut.png"}}};
    EXPECT_EQ(error_of(glb), "images[0]: the PNG is cut short");
    const std::string jpeg = "\xFF\xD8\xFF\xE0";
    GlbBuilder::write_file(folder_ / "cut.jpg", std::vector<std::uint8_t>(jpeg.begin(), jpeg.end()));
    glb.json["images"] = {{{"uri", "cut.jpg"}}};
    EXPECT_TRUE(error_of(glb).starts_with("images[0]: the image cannot be decoded (")) << error_of(glb);
    glb.json["textures"] = {{{"source", 5}}};
    EXPECT_EQ(error_of(glb), "textures[0].source: there is no images[5], the file has 1 images");
}

TEST_F(BadInput, Meshopt) {
    GlbBuilder glb = good();
    json extension = {{"buffer", 0},      {"byteOffset", 0}, {"byteLength", 16},
                      {"byteStride", 12}, {"count", 4},      {"mode", "ATTRIBUTES"}};
    json& view = glb.json["bufferViews"][0];
    view["extensions"]["EXT_meshopt_compression"] = extension;
    EXPECT_EQ(error_of(glb), "bufferViews[0].extensions.EXT_meshopt_compression: the compressed bytes are not valid");
    const std::string place = "bufferViews[0].extensions.EXT_meshopt_compression";
    view["extensions"]["EXT_meshopt_compression"]["count"] = 100'000'000;
    EXPECT_EQ(error_of(glb), place + ".count: 16 bytes cannot hold 100000000 elements of 12 bytes");
    view["extensions"]["EXT_meshopt_compression"]["count"] = 3;
    EXPECT_EQ(error_of(glb), place + ": count times byteStride is not the bufferView's byteLength");
    view["extensions"]["EXT_meshopt_compression"]["mode"] = "MAGIC";
    EXPECT_EQ(error_of(glb), place + ".mode: \"MAGIC\" is not ATTRIBUTES, TRIANGLES or INDICES");
    extension["filter"] = "QUATERNION";
    view["extensions"]["EXT_meshopt_compression"] = extension;
    EXPECT_EQ(error_of(glb), place + ".filter: \"QUATERNION\" does not go with mode ATTRIBUTES and byteStride 12");
}

TEST_F(BadInput, Draco) {
    GlbBuilder glb = good();
    glb.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                                   {"attributes", {{"POSITION", 0}}}};
    const std::string place = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
    EXPECT_EQ(error_of(glb), place + ": the compressed bytes are not Draco's");
    const auto with_header = [&](std::vector<std::uint8_t> header) {
        std::memcpy(glb.bin.data(), header.data(), header.size());
        return error_of(glb);
    };
    // magic, version 2.2, mesh, sequential, flags; then varints: faces, points
    EXPECT_EQ(with_header({'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 4}),
              place + ": 48 bytes cannot hold 4294967295 triangles");
    EXPECT_EQ(with_header({'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 7, 4}),
              place + ": the Draco data has 7 triangles, but the accessor of the indices says 6 indices");
    EXPECT_EQ(with_header({'D', 'R', 'A', 'C', 'O', 1, 1, 1, 0, 0, 0}),
              place + ": Draco bitstream version 1.1 is not understood, only 2.2 is");
    EXPECT_TRUE(with_header({'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 2, 4}).starts_with(place + ": "))
        << error_of(glb);
}

TEST_F(BadInput, Obj) {
    EXPECT_EQ(error_of_text("a.obj", "# nothing\n"), "the file has no faces (statements v and f)");
    EXPECT_EQ(error_of_text("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n"),
              "line 3: \"nan\" is not a finite number");
    EXPECT_EQ(error_of_text("a.obj", "v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n"), "line 2: \"\" is not a finite number");
    EXPECT_EQ(error_of_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
              "line 4: \"4\" names a vertex that does not exist, the file has 3");
    EXPECT_EQ(error_of_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/1 3/1\n"),
              "line 4: \"1\" names a texture coordinate that does not exist, the file has 0");
    EXPECT_EQ(error_of_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n"),
              "line 4: \"-4\" names a vertex that does not exist, the file has 3");
    EXPECT_EQ(error_of_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf a b c\n"), "line 4: \"a\" is not an index");
}

}  // namespace
}  // namespace blush
