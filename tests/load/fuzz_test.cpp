// Thousands of damaged files, always the same ones: each must load or give a sentence, never crash or hang.
#include <gtest/gtest.h>

#include <random>

#include "runtime/files/face_file.h"
#include "tests/load/compressed_glb.h"

namespace blush {
namespace {

using nlohmann::json;
using test::GlbBuilder;

GlbBuilder rich_file() {
    GlbBuilder glb;
    glb.grid(2, 2).target("jawOpen", {0, 1}, {{0, -1, 0}, {0, -1, 0}}, {{0, 0, 1}, {0, 1, 0}});
    glb.dense_target("puff", std::vector<glm::vec3>(9, {0, 0, 1}));
    glb.attribute("WEIGHTS_0", std::vector<glm::vec4>(9, glm::vec4(1, 0, 0, 0)));
    glb.primitive()["attributes"]["JOINTS_0"] =
        glb.accessor(std::vector<glm::u16vec4>(9, glm::u16vec4(0)), "VEC4", 5123);
    glb.weight_animation({0, 1}, {0, 0, 1, 1})
        .node_animation("translation", {0, 1}, std::vector<glm::vec3>(6), "CUBICSPLINE");
    glb.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"name", "joint"}, {"rotation", {0, 0, 0, 1}}}};
    glb.json["skins"] = {
        {{"joints", {1}}, {"inverseBindMatrices", glb.accessor(std::vector<glm::mat4>(1, glm::mat4(1)), "MAT4")}}};
    glb.json["materials"] = {
        {{"name", "skin"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}, {"extras", {{"a", {1, 2}}}}}};
    glb.primitive()["material"] = 0;
    return glb;
}

GlbBuilder meshopt_file() {
    GlbBuilder glb = rich_file();
    test::compress_view(glb, 0, 12, "ATTRIBUTES", "EXPONENTIAL");
    test::compress_view(glb, 1, 4, "TRIANGLES");
    return glb;
}

/// Every value in the document, for the mutator to pick from.
void collect(json& value, std::vector<json*>& all) {
    all.push_back(&value);
    if (value.is_structured()) {
        for (json& element : value) collect(element, all);
    }
}

class Mutator {
public:
    explicit Mutator(std::uint32_t seed) : random_(seed) {}

    std::vector<std::uint8_t> damage_bytes(std::vector<std::uint8_t> file) {
        const std::size_t hits = 1 + below(6);
        for (std::size_t i = 0; i < hits && !file.empty(); ++i) {
            const std::size_t place = below(file.size());
            switch (below(4)) {
                case 0:
                    file[place] = static_cast<std::uint8_t>(below(256));
                    break;
                case 1:
                    file[place] = static_cast<std::uint8_t>(file[place] ^ (1U << below(8)));
                    break;
                case 2:
                    file.erase(file.begin() + static_cast<std::ptrdiff_t>(place));
                    break;
                default:
                    file.insert(file.begin() + static_cast<std::ptrdiff_t>(place),
                                static_cast<std::uint8_t>(below(256)));
            }
        }
        return file;
    }

    void damage_json(json& document) {
        static const std::vector<json> odd = {nullptr,
                                              true,
                                              -1,
                                              0,
                                              1,
                                              2,
                                              3,
                                              4,
                                              12,
                                              255,
                                              5121,
                                              5123,
                                              5125,
                                              5126,
                                              2147483647,
                                              2147483648U,
                                              1e300,
                                              0.5,
                                              "",
                                              "VEC3",
                                              "SCALAR",
                                              json::array(),
                                              json::object(),
                                              json::array({0, 0})};
        const std::size_t hits = 1 + below(3);
        for (std::size_t i = 0; i < hits; ++i) {
            std::vector<json*> all;
            collect(document, all);
            json& victim = *all[below(all.size())];
            if (victim.is_object() && !victim.empty() && below(2) == 0) {
                victim.erase(std::next(victim.begin(), static_cast<std::ptrdiff_t>(below(victim.size()))));
            } else {
                victim = odd[below(odd.size())];
            }
        }
    }

    std::size_t below(std::size_t end) { return random_() % end; }

private:
    std::mt19937 random_;
};

class Fuzz : public testing::Test {
protected:
    void load(const std::string& name, std::span<const std::uint8_t> file) {
        const auto path = folder_ / name;
        GlbBuilder::write_file(path, file);
        const Result<Face> face = load_face(path);
        if (face) {
            ++loaded_;
            EXPECT_TRUE(validate(*face));
        } else {
            ++refused_;
            EXPECT_TRUE(face.error().message.starts_with(path.string() + ": ")) << face.error().message;
            EXPECT_EQ(face.error().message.find('\n'), std::string::npos) << face.error().message;
        }
    }

    void load_damaged(const GlbBuilder& good, std::size_t rounds) {
        load("good.glb", good.bytes());
        ASSERT_EQ(loaded_, 1U) << load_face(folder_ / "good.glb").error().message;
        for (std::size_t i = 0; i < rounds; ++i) {
            GlbBuilder glb = good;
            if (i % 3 == 0) {
                load("damaged.glb", mutator_.damage_bytes(glb.bytes()));
            } else if (i % 3 == 1) {
                glb.bin = mutator_.damage_bytes(glb.bin);
                glb.bin.resize(good.bin.size());
                load("damaged.glb", glb.bytes());
            } else {
                if (!glb.json.contains("buffers")) glb.json["buffers"] = {{{"byteLength", glb.bin.size()}}};
                mutator_.damage_json(glb.json);
                load("damaged.glb", GlbBuilder::file_of(glb.json.dump(), glb.bin));
            }
        }
        EXPECT_GT(refused_, rounds / 10);
    }

    test::TemporaryFolder folder_;
    Mutator mutator_{20120609};  // any fixed seed
    std::size_t loaded_ = 0, refused_ = 0;
};

TEST_F(Fuzz, PlainGlb) { load_damaged(rich_file(), 1500); }
TEST_F(Fuzz, MeshoptGlb) { load_damaged(meshopt_file(), 800); }
TEST_F(Fuzz, DracoGlb) { load_damaged(test::draco_fan(12), 800); }

TEST_F(Fuzz, Obj) {
    const std::string good =
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl skin\n"
        "f 1/1/1 2/2/1 3/3/1 4//1\nf -4 -3 -2\\\n -1\n";
    load("good.obj", std::vector<std::uint8_t>(good.begin(), good.end()));
    ASSERT_EQ(loaded_, 1U) << load_face(folder_ / "good.obj").error().message;
    for (int i = 0; i < 600; ++i)
        load("damaged.obj", mutator_.damage_bytes(std::vector<std::uint8_t>(good.begin(), good.end())));
    EXPECT_GT(refused_, 60U);
}

}  // namespace
}  // namespace blush
