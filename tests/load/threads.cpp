// Loaders that four threads call at once, on one file and on different ones, read what one thread reads.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "runtime/files/appearance_file.h"
#include "runtime/files/face_appearance.h"
#include "runtime/files/face_file.h"
#include "runtime/files/lighting_file.h"
#include "runtime/files/occlusion_file.h"
#include "runtime/files/output_file.h"
#include "runtime/files/performance/performance_file.h"
#include "runtime/files/rig_description_file.h"
#include "tests/four_threads.h"
#include "tests/load/compressed_glb.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

namespace fs = std::filesystem;

/// All that was read, as one string, so that two readings can be compared to the bit.
class Contents {
public:
    template <class T>
    Contents& add(const std::vector<T>& values) {
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return *this;
    }
    Contents& add(const std::string& text) {
        bytes_ += text + '\n';
        return *this;
    }
    Contents& add(const Track& track) { return add(track.times_seconds).add(track.values); }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

std::string contents_of(const Face& face) {
    Contents all;
    all.add(face.positions).add(face.normals).add(face.tangents).add(face.uv0).add(face.indices);
    for (const Target& target : face.targets)
        all.add(target.name).add(target.vertices).add(target.position_deltas).add(target.normal_deltas);
    for (const Image& image : face.images) all.add(image.name).add(image.bytes).add(image.floats);
    for (const std::string& note : face.notes) all.add(note);
    return all.take();
}

std::string contents_of(const FaceAppearance& appearance) {
    Contents all;
    if (appearance.wrinkles) {
        all.add(appearance.wrinkles->derivatives.values);
        for (const ScalarMap& mask : appearance.wrinkles->masks) all.add(mask.values);
    }
    if (appearance.pigments) {
        const auto& [maps, blood] = *appearance.pigments;
        all.add(maps.melanin.values).add(maps.hemoglobin.values).add(maps.residual.values);
        for (const HemoglobinChange& change : blood.changes) all.add(change.scale.values).add(change.offset.values);
    }
    return all.take();
}

std::string contents_of(const std::optional<OcclusionSet>& set) {
    Contents all;
    if (!set) return {};
    for (const OcclusionPose& pose : set->poses) all.add(pose.target).add(pose.transfers);
    return all.take();
}

std::string contents_of(const Performance& performance) {
    Contents all;
    for (const PerformanceChannel& channel : performance.channels) all.add(channel.name).add(channel.track);
    for (const PerformanceLayer& layer : performance.layers) all.add(layer.name).add(layer.weight);
    return all.take();
}

std::string contents_of(const std::shared_ptr<const Environment>& environment) {
    Contents all;
    for (const Environment::Level& level : environment->levels) all.add(level.rgb_linear);
    return all.take();
}

std::string contents_of(const RigDescription& description) {
    Contents all;
    for (const auto& expression : description.expressions) all.add(expression.name);
    return all.take();
}

template <class T>
std::string contents_of(const Result<T>& read) {
    return read ? contents_of(*read) : "error: " + read.error().message;
}

using Loader = std::function<std::string()>;

class Threads : public testing::Test {
protected:
    /// All at one file, then each at another, so that every pair of files is read side by side.
    static void expect_same_on_four_threads(const std::vector<Loader>& loaders) {
        std::vector<std::string> alone;
        // Threads first: what a library makes once is then made by four at once.
        std::vector<std::array<std::string, test::thread_count>> same, different;
        for (std::size_t file = 0; file < loaders.size(); ++file) {
            same.push_back(test::on_four_threads([&](std::size_t) { return loaders[file](); }));
            different.push_back(
                test::on_four_threads([&](std::size_t thread) { return loaders[(file + thread) % loaders.size()](); }));
        }
        for (const Loader& load : loaders) alone.push_back(load());
        for (std::size_t file = 0; file < loaders.size(); ++file) {
            EXPECT_FALSE(alone[file].empty()) << file;
            for (std::size_t thread = 0; thread < test::thread_count; ++thread) {
                EXPECT_EQ(same[file][thread], alone[file]) << file;
                EXPECT_EQ(different[file][thread], alone[(file + thread) % loaders.size()]) << file;
            }
        }
    }

    fs::path path(const std::string& name) const { return folder_ / name; }

    void write_picture(const std::string& name, std::uint32_t channels) const {
        test::Random random(channels);
        Image image{.name = name, .width = 32, .height = 32, .channels = channels, .bytes = {}, .floats = {}};
        image.bytes.resize(std::size_t{32} * 32 * channels);
        for (std::uint8_t& byte : image.bytes) byte = static_cast<std::uint8_t>(random.between(0, 255));
        ASSERT_TRUE(write_image(path(name), image));
    }

    Loader face(const std::string& name) const {
        return [file = path(name)] { return contents_of(load_face(file)); };
    }

private:
    test::TemporaryFolder folder_;
};

TEST_F(Threads, Faces) {
    write_picture("skin.png", 3);
    test::GlbBuilder textured;
    textured.grid(12, 12).target("jawOpen", {3, 4, 40}, {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}});
    textured.json["images"] = {{{"uri", "skin.png"}}};
    textured.json["textures"] = {{{"source", 0}}};
    textured.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    textured.primitive()["material"] = 0;
    textured.write(path("textured.glb"));
    test::GlbBuilder meshopt;
    meshopt.grid(8, 8);
    test::compress_view(meshopt, 0, 12, "ATTRIBUTES");
    meshopt.write(path("meshopt.glb"));
    test::draco_fan(24).write(path("draco.glb"));
    std::ofstream(path("face.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                                       "f 1/1 2/2 3/3\nf 2/2 4/4 3/3\n";
    std::ofstream(path("damaged.glb")) << "glTF, they say";
    expect_same_on_four_threads(
        {face("textured.glb"), face("meshopt.glb"), face("draco.glb"), face("face.obj"), face("damaged.glb")});
}

TEST_F(Threads, WhatBelongsToAFace) {
    Face head = test::make_face({.side = 6, .targets = 2});
    head.path = path("head.glb").string();
    test::Random random(5);
    OcclusionSet occlusion{.face_identity = occlusion_identity(head), .poses = {{"", {}}}};
    for (std::size_t v = 0; v < head.positions.size(); ++v)
        occlusion.poses[0].transfers.push_back({random.between(0, 1), random.between(0, 1)});
    ASSERT_TRUE(write_occlusion(occlusion_path(head.path), occlusion));

    const fs::path maps = appearance_folder(head.path);
    fs::create_directory(maps);
    const ScalarMap grey(16, 16, 0.25F);
    ASSERT_TRUE(write_appearance(maps, {.melanin = ScalarMap(16, 16, 0.01F),
                                        .hemoglobin = ScalarMap(16, 16, 0.01F),
                                        .skin = ScalarMap(16, 16, 1),
                                        .residual = ColourMap(16, 16, Vec3(0.9F))}));
    ASSERT_TRUE(write_hemoglobin_maps(maps, {.names = {"joy", "anger"}, .changes = {{grey, grey}, {grey, grey}}}));
    ASSERT_TRUE(write_wrinkles(maps, {.zones = {"crow_left"},
                                      .derivatives = DerivativeMap(16, 16, Vec2(0.1F, -0.2F)),
                                      .masks = {ScalarMap(16, 16, 0)},
                                      .part = {}}));
    std::ofstream(path("face.rig.json")) << R"({"expressions": []})";
    expect_same_on_four_threads({[&] { return contents_of(load_face_appearance(maps)); },
                                 [&] { return contents_of(find_occlusion(head)); },
                                 [&] { return contents_of(find_rig_description(head)); }});
}

TEST_F(Threads, PerformancesAndLight) {
    const fs::path assets = fs::path(BLUSH_SOURCE_DIR) / "assets/performances";
    std::ofstream(path("take.csv"))
        << "Timecode,BlendShapeCount,JawOpen\n00:00:01:00.000,1,0.5\n00:00:01:01.000,1,0.7\n";
    Image sky{.name = "", .width = 16, .height = 8, .channels = 3, .bytes = {}, .floats = {}};
    sky.floats.assign(std::size_t{16} * 8 * 3, 0.5F);
    ASSERT_TRUE(write_image(path("sky.exr"), sky));
    const auto performance = [](const fs::path& file) -> Loader {
        return [file] { return contents_of(load_performance(file)); };
    };
    expect_same_on_four_threads({performance(assets / "compliment.json"), performance(assets / "first_light.json"),
                                 performance(path("take.csv")),
                                 [&] { return contents_of(read_environment(path("sky.exr"))); }});
}

}  // namespace
}  // namespace blush
