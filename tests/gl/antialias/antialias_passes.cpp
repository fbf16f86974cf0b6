// The passes of MLAA and SMAA on the GPU against their plain twins on the CPU.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "rig/antialias/blend.h"
#include "rig/antialias/edges.h"
#include "rig/antialias/weights.h"
#include "runtime/antialias/antialias_passes.h"
#include "runtime/files/face_file.h"
#include "runtime/files/import/import_head.h"
#include "runtime/gl/state_guard.h"
#include "tests/antialias_pictures.h"
#include "tests/gl_fixture.h"
#include "tests/shared_data.h"

namespace blush {
namespace {

using test::NamedPicture;

/// A texture with its framebuffer.
struct Surface {
    Surface(int columns, int rows, GLenum format)
        : width(columns), height(rows), texture(gl::make_texture(GL_TEXTURE_2D)), framebuffer(gl::make_framebuffer()) {
        glTextureStorage2D(texture.name(), 1, format, width, height);
        glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
    }
    PassTarget target() const {
        return {framebuffer.name(), static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    }
    template <class T>
    std::vector<T> read(GLenum format, GLenum type, std::size_t channels) const {
        std::vector<T> values(channels * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        glGetTextureImage(texture.name(), 0, format, type, static_cast<GLsizei>(values.size() * sizeof(T)),
                          values.data());
        return values;
    }
    int width, height;
    gl::Texture texture;
    gl::Framebuffer framebuffer;
};

Surface upload(const Pixels& picture, GLenum format) {
    Surface surface(picture.width, picture.height, format);
    glTextureSubImage2D(surface.texture.name(), 0, 0, 0, picture.width, picture.height, GL_RGBA, GL_FLOAT,
                        picture.cells.data());
    return surface;
}
Surface upload(const DepthPixels& depth) {
    Surface surface(depth.width, depth.height, GL_R32F);
    glTextureSubImage2D(surface.texture.name(), 0, 0, 0, depth.width, depth.height, GL_RED, GL_FLOAT,
                        depth.cells.data());
    return surface;
}

EdgeMap read_edges(const Surface& surface) {
    EdgeMap edges(surface.width, surface.height);
    const auto bytes = surface.read<std::uint8_t>(GL_RG, GL_UNSIGNED_BYTE, 2);
    for (std::size_t i = 0; i < edges.cells.size(); ++i) {
        EXPECT_TRUE((bytes[2 * i] == 0 || bytes[2 * i] == 255) && (bytes[2 * i + 1] == 0 || bytes[2 * i + 1] == 255));
        edges.cells[i] = {bytes[2 * i] / 255, bytes[2 * i + 1] / 255};
    }
    return edges;
}

int worst_difference(const Surface& surface, const WeightMap& expected) {
    const auto bytes = surface.read<std::uint8_t>(GL_RGBA, GL_UNSIGNED_BYTE, 4);
    int worst = 0;
    for (std::size_t i = 0; i < expected.cells.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            const int wanted = expected.cells[i][static_cast<glm::length_t>(c)];
            worst = std::max(worst, std::abs(bytes[4 * i + c] - wanted));
        }
    }
    return worst;
}

/// Relative above 1; infinite where one is not finite and the other is not the same.
double worst_difference(const Surface& surface, const Pixels& expected) {
    const auto floats = surface.read<float>(GL_RGBA, GL_FLOAT, 4);
    double worst = 0;
    for (std::size_t i = 0; i < expected.cells.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            const double wanted = static_cast<double>(expected.cells[i][static_cast<glm::length_t>(c)]);
            const double got = static_cast<double>(floats[4 * i + c]);
            if (wanted == got || (std::isnan(wanted) && std::isnan(got))) continue;
            const double difference = std::abs(got - wanted) / std::max(1.0, std::abs(wanted));
            worst = std::isfinite(difference) ? std::max(worst, difference) : std::numeric_limits<double>::infinity();
        }
    }
    return worst;
}

/// One step of 8 bits, which rounding may go astray by, and the rounding of the reference.
constexpr double byte = 1.001 / 255;

class AntialiasPassesTest : public test::GlTest {
protected:
    AntialiasPassesTest() {
        Result<AntialiasPasses> made = AntialiasPasses::create();
        if (!made) {
            ADD_FAILURE() << made.error().message;
            std::abort();
        }
        passes_ = std::make_unique<AntialiasPasses>(*std::move(made));
    }

    std::unique_ptr<AntialiasPasses> passes_;
};

/// Everything that a filter does to one picture.
struct Steps {
    Steps(const Pixels& pixels, GLenum format)
        : picture(pixels),
          color(upload(pixels, format)),
          edges(color.width, color.height, GL_RG8),
          weights(color.width, color.height, GL_RGBA8),
          out(color.width, color.height, format) {}
    const Pixels& picture;
    Surface color, edges, weights, out;
    EdgeTiles tiles;
};

void expect_smaa(const AntialiasPasses& passes, Steps& steps, const SmaaSettings& settings, SubsampleSlices slices,
                 const PictureMeaning& meaning) {
    const EdgeMap edges = find_edges(steps.picture, {}, settings.edges, meaning);
    const WeightMap weights = smaa_weights(edges, settings, slices);
    passes.edges(steps.color.texture.name(), 0, settings.edges, meaning, steps.tiles, steps.edges.target());
    EXPECT_TRUE(read_edges(steps.edges).cells == edges.cells);
    passes.smaa_weights(steps.edges.texture.name(), settings, slices, steps.tiles, steps.weights.target());
    EXPECT_LE(worst_difference(steps.weights, weights), 1);
    passes.blend(steps.color.texture.name(), steps.weights.texture.name(), meaning, steps.tiles, steps.out.target());
    EXPECT_LE(worst_difference(steps.out, blend_neighbors(steps.picture, weights, meaning)), byte);
}

void expect_mlaa(const AntialiasPasses& passes, Steps& steps, const MlaaSettings& settings) {
    const EdgeMap edges = find_edges(steps.picture, {}, settings.edges, {});
    const WeightMap weights = mlaa_weights(edges, settings);
    passes.edges(steps.color.texture.name(), 0, settings.edges, {}, steps.tiles, steps.edges.target());
    EXPECT_TRUE(read_edges(steps.edges).cells == edges.cells);
    passes.mlaa_weights(steps.edges.texture.name(), settings, steps.tiles, steps.weights.target());
    EXPECT_LE(worst_difference(steps.weights, weights), 1);
    passes.blend(steps.color.texture.name(), steps.weights.texture.name(), {}, steps.tiles, steps.out.target());
    EXPECT_LE(worst_difference(steps.out, blend_neighbors(steps.picture, weights, {})), byte);
}

/// All pictures of a list beside and below each other, a dark margin around each: one upload instead of many. Its
/// right side does not end on a tile.
Pixels sheet_of(const std::vector<NamedPicture>& pictures) {
    constexpr int width = 501, margin = 5;
    std::vector<glm::ivec2> places;
    glm::ivec2 at(margin);
    int row_height = 0;
    for (const NamedPicture& picture : pictures) {
        if (at.x + picture.pixels.width + margin > width) {
            at = {margin, at.y + row_height + margin};
            row_height = 0;
        }
        places.push_back(at);
        at.x += picture.pixels.width + margin;
        row_height = std::max(row_height, picture.pixels.height);
    }
    Pixels sheet(width, at.y + row_height + margin, {0, 0, 0, 1});
    for (std::size_t p = 0; p < pictures.size(); ++p) {
        const Pixels& pixels = pictures[p].pixels;
        for (int y = 0; y < pixels.height; ++y) {
            for (int x = 0; x < pixels.width; ++x) sheet.at(places[p].x + x, places[p].y + y) = pixels.at(x, y);
        }
    }
    return sheet;
}

TEST_F(AntialiasPassesTest, EqualTheirTwinsOnASheetOfPictures) {
    const gl::StateGuard guard;
    const auto pictures = test::antialias_pictures();
    ASSERT_GE(pictures.size(), 150U);
    const Pixels sheet = sheet_of(pictures);
    Steps steps(sheet, GL_RGBA8);
    for (std::size_t preset = 0; preset < smaa_preset_names.size(); ++preset) {
        SCOPED_TRACE(smaa_preset_names[preset]);
        expect_smaa(*passes_, steps, smaa_preset(static_cast<SmaaPreset>(preset)), SubsampleSlices(0), {});
    }
    for (const int search_steps : {1, 4}) {
        MlaaSettings settings;
        settings.search_steps = search_steps;
        expect_mlaa(*passes_, steps, settings);
    }
    // All slices of the tables, odd reaches, corners as they are.
    for (int slice = 1; slice < 7; slice += 2) {
        SmaaSettings settings;
        settings.edges.source = slice == 3 ? EdgeSource::color : EdgeSource::luma;
        settings.edges.contrast_factor = slice < 4 ? 0.5F : 0;
        settings.search_steps = slice;
        settings.diagonal_search_steps = 2 * slice;
        settings.corner_rounding = static_cast<float>(slice) / 6;
        const SubsampleSlices slices(slice, 7 - slice, (slice + 2) % 7, (slice + 4) % 7);
        PictureMeaning meaning;
        meaning.blend_in_linear_light = slice == 1;
        expect_smaa(*passes_, steps, settings, slices, meaning);
    }
}

TEST_F(AntialiasPassesTest, EqualTheirTwinsOnPicturesOfEverySize) {
    const gl::StateGuard guard;
    for (const NamedPicture& picture : test::antialias_pictures()) {
        const int width = picture.pixels.width, height = picture.pixels.height;
        // Lines that leave the picture, sides of one or two pixels, sides that do not end on a tile.
        const bool odd = width < 3 || height < 4 || width > 100 || picture.name.find("noise") != std::string::npos;
        if (!odd) continue;
        SCOPED_TRACE(picture.name);
        Steps steps(picture.pixels, GL_RGBA8);
        expect_smaa(*passes_, steps, smaa_preset(SmaaPreset::high), SubsampleSlices(0), {});
        expect_mlaa(*passes_, steps, {});
    }
}

TEST_F(AntialiasPassesTest, FindEdgesOfEverySourceAsTheirTwin) {
    const gl::StateGuard guard;
    const Pixels sheet = sheet_of(test::antialias_pictures());
    const Surface color = upload(sheet, GL_RGBA32F);
    DepthPixels depth(sheet.width, sheet.height);
    for (std::size_t i = 0; i < depth.cells.size(); ++i) depth.cells[i] = 0.5F + sheet.cells[i].g * 0.1F;
    const Surface depth_surface = upload(depth), edges(color.width, color.height, GL_RG8);
    EdgeTiles tiles;
    for (const EdgeSource source : {EdgeSource::luma, EdgeSource::color, EdgeSource::depth}) {
        for (const AlphaMeaning alpha : {AlphaMeaning::carried, AlphaMeaning::straight, AlphaMeaning::premultiplied}) {
            const bool on = alpha != AlphaMeaning::carried;
            EdgeSettings settings;
            settings.source = source;
            settings.predication.on = on;
            const PictureMeaning meaning{on ? Transfer::linear : Transfer::srgb, alpha, true};
            passes_->edges(color.texture.name(), depth_surface.texture.name(), settings, meaning, tiles,
                           edges.target());
            EXPECT_TRUE(read_edges(edges).cells == find_edges(sheet, depth, settings, meaning).cells)
                << static_cast<int>(source) << static_cast<int>(alpha);
        }
    }
}

TEST_F(AntialiasPassesTest, EqualTheirTwinsOnFloatsOfEveryKind) {
    const gl::StateGuard guard;
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float odd : {0.5F, 900.0F, -2.0F, nan, infinity, -infinity}) {
        for (const AlphaMeaning alpha : {AlphaMeaning::carried, AlphaMeaning::straight}) {
            for (const Transfer transfer : {Transfer::srgb, Transfer::linear}) {
                Pixels picture = test::noise_picture(33, 30, 4, 3, false);
                for (int k = 0; k < 30; k += 4) picture.at(k, (7 * k) % 30) = {odd, odd, 0.3F, 1};
                for (int k = 0; k < 30; k += 3) picture.at(k, (11 * k) % 30).w = 0.4F;
                Steps steps(picture, GL_RGBA32F);
                expect_smaa(*passes_, steps, smaa_preset(SmaaPreset::high), SubsampleSlices(0),
                            {transfer, alpha, true});
            }
        }
    }
}

Pixels pixels_of(const Image& image) {
    Pixels picture(static_cast<int>(image.width), static_cast<int>(image.height));
    for (std::size_t p = 0; p < picture.cells.size(); ++p) {
        for (std::size_t c = 0; c < 4; ++c) {
            picture.cells[p][static_cast<glm::length_t>(c)] = static_cast<float>(image.bytes[4 * p + c]) / 255.0F;
        }
    }
    return picture;
}

TEST_F(AntialiasPassesTest, EqualTheirTwinsOnRenderedFaces) {
    const gl::StateGuard guard;
    test::FaceOptions options;
    options.targets = 4;
    Portrait character = make_character(test::make_face(options));
    const Offscreen offscreen = make_offscreen(96, 96);
    for (const float weight : {0.0F, 1.0F}) {
        test::set_weights(character, {weight, 0, weight, 0});
        const Pixels picture = pixels_of(test::draw(character, offscreen));
        Steps steps(picture, GL_RGBA8);
        SmaaSettings settings = smaa_preset(SmaaPreset::ultra);
        settings.edges.threshold = 0.02F;  // the little face is lit softly
        expect_smaa(*passes_, steps, settings, SubsampleSlices(0), {});
        expect_mlaa(*passes_, steps, {});
    }
}

/// A real head from the shared data, or nothing where it is absent.
std::optional<Face> real_head(const std::string& name) {
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::path(testing::TempDir()) / ("blush_real_head_" + std::to_string(std::random_device{}()));
    fs::create_directories(folder);
    const auto imported = [&](const Result<ImportedHead>& head) -> Result<Face> {
        if (!head) return head.error();
        const fs::path file = folder / "head.glb";
        std::ofstream(file, std::ios::binary) << head->glb;
        return load_face(file);
    };
    const auto found = test::shared_data("faces/" + name);
    if (!found) return std::nullopt;
    const auto load = [&]() -> Result<Face> {
        if (found->extension() == ".glb") return load_face(*found);
        if (fs::is_directory(*found)) return imported(import_makehuman(*found));
        // The head at rest alone: it comes first in the archive.
        const std::string command =
            "tar -xJf '" + found->string() + "' -C '" + folder.string() + "' --occurrence=1 generic_neutral_mesh.obj";
        if (std::system(command.c_str()) != 0) return Error{"tar failed"};
        return imported(import_ict(folder));
    };
    Result<Face> face = load();
    fs::remove_all(folder);
    if (face) return *std::move(face);
    ADD_FAILURE() << name << ": " << face.error().message;
    return std::nullopt;
}

/// Each from the front, from the side and from below, on one sheet.
TEST_F(AntialiasPassesTest, EqualTheirTwinsOnFramesOfRealHeads) {
    BLUSH_SHARED_OR_SKIP(faces, "faces");
    const Offscreen offscreen = make_offscreen(115, 120);
    std::vector<NamedPicture> frames;
    for (const char* name : {"lee-perry-smith/LeePerrySmith.glb", "facecap/facecap_plain.glb",
                             "ict-facekit/ict_expr.tar.xz", "makehuman"}) {
        std::optional<Face> face = real_head(name);
        ASSERT_TRUE(face) << faces / name;
        Portrait character = make_character(*std::move(face));
        ASSERT_TRUE(character.set("antialiasing.mode", "none"));
        for (const auto& [yaw, pitch] : {std::pair(0.0F, 0.0F), {0.9F, 0.1F}, {-0.4F, -0.5F}}) {
            ViewFrame view = test::framed_view(character, offscreen);
            OrbitCamera camera = character.framing(1);
            camera.yaw_radians = yaw;
            camera.pitch_radians = pitch;
            view.camera = camera.camera(1);
            const Image image = test::draw(character, offscreen, view);
            EXPECT_GT(test::colour_count(image), test::fewest_colours) << name;
            frames.push_back({name, pixels_of(image)});
        }
    }
    const gl::StateGuard guard;
    const Pixels sheet = sheet_of(frames);
    Steps steps(sheet, GL_RGBA8);
    for (const SmaaPreset preset : {SmaaPreset::low, SmaaPreset::ultra}) {
        expect_smaa(*passes_, steps, smaa_preset(preset), SubsampleSlices(0), {});
    }
    SmaaSettings by_color = smaa_preset(SmaaPreset::high);
    by_color.edges.source = EdgeSource::color;
    by_color.edges.threshold = 0.02F;  // wrinkles and lips too
    expect_smaa(*passes_, steps, by_color, SubsampleSlices(1, 2, 3, 4), {});
    expect_mlaa(*passes_, steps, {});
}

TEST_F(AntialiasPassesTest, APictureWithoutEdgesKeepsItsBits) {
    const gl::StateGuard guard;
    for (const GLenum format : {GLenum{GL_RGBA8}, GLenum{GL_RGBA32F}}) {
        const bool bytes = format == GL_RGBA8;
        const Pixels picture(21, 10, bytes ? glm::vec4(17, 99, 201, 3) / 255.0F : glm::vec4(-3, 7e4F, 0.1F, 0.7F));
        Steps steps(picture, format);
        expect_smaa(*passes_, steps, smaa_preset(SmaaPreset::ultra), SubsampleSlices(0), {});
        const auto in = steps.color.read<float>(GL_RGBA, GL_FLOAT, 4);
        EXPECT_TRUE(in == steps.out.read<float>(GL_RGBA, GL_FLOAT, 4));
    }
}

TEST_F(AntialiasPassesTest, TilesMayBeUsedForPicturesOfChangingSize) {
    const gl::StateGuard guard;
    EdgeTiles tiles;
    for (const int side : {16, 70, 9}) {
        const Pixels picture = test::noise_picture(side, side, 3, 2, true);
        Steps steps(picture, GL_RGBA8);
        std::swap(steps.tiles, tiles);
        expect_smaa(*passes_, steps, {}, SubsampleSlices(0), {});
        std::swap(steps.tiles, tiles);
    }
}

}  // namespace
}  // namespace blush
