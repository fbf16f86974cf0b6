// The passes of MLAA and SMAA on the GPU against their plain twins on the CPU.

#include <gtest/gtest.h>

#include "rig/antialias/blend.h"
#include "rig/antialias/edges.h"
#include "rig/antialias/weights.h"
#include "runtime/antialias/antialias_passes.h"
#include "runtime/gl/state_guard.h"
#include "tests/antialias_pictures.h"
#include "tests/gl_fixture.h"

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

class AntialiasPassesTest : public test::GlTest {
protected:
    AntialiasPassesTest() {
        Result<AntialiasPasses> made = AntialiasPasses::create();
        EXPECT_TRUE(made) << made.error().message;
        passes_ = std::make_unique<AntialiasPasses>(*std::move(made));
    }

    static int worst_difference(const Surface& surface, const WeightMap& expected) {
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
    static double worst_difference(const Surface& surface, const Pixels& expected) {
        const auto floats = surface.read<float>(GL_RGBA, GL_FLOAT, 4);
        double worst = 0;
        for (std::size_t i = 0; i < expected.cells.size(); ++i) {
            for (std::size_t c = 0; c < 4; ++c) {
                const float wanted = expected.cells[i][static_cast<glm::length_t>(c)];
                const double difference = std::abs(static_cast<double>(floats[4 * i + c] - wanted));
                worst = std::max(worst, difference / std::max(1.0, std::abs(static_cast<double>(wanted))));
            }
        }
        return worst;
    }

    std::unique_ptr<AntialiasPasses> passes_;
};

TEST_F(AntialiasPassesTest, EqualTheirTwinsOnEveryPicture) {
    const gl::StateGuard guard;
    const auto pictures = test::antialias_pictures();
    ASSERT_GE(pictures.size(), 50U);
    for (const NamedPicture& picture : pictures) {
        SCOPED_TRACE(picture.name);
        const Surface color = upload(picture.pixels, GL_RGBA8);
        const Surface edges(color.width, color.height, GL_RG8), weights(color.width, color.height, GL_RGBA8),
            out(color.width, color.height, GL_RGBA8);
        for (const SmaaPreset preset : {SmaaPreset::low, SmaaPreset::high, SmaaPreset::ultra}) {
            const SmaaSettings settings = smaa_preset(preset);
            const PictureMeaning meaning;
            const EdgeMap expected_edges = find_edges(picture.pixels, {}, settings.edges, meaning);
            const WeightMap expected_weights = blush::smaa_weights(expected_edges, settings);
            passes_->edges(color.texture.name(), 0, settings.edges, meaning, edges.target());
            EXPECT_EQ(read_edges(edges).cells, expected_edges.cells);
            passes_->smaa_weights(edges.texture.name(), settings, SubsampleSlices(0), weights.target());
            EXPECT_LE(worst_difference(weights, expected_weights), 0);
            passes_->blend(color.texture.name(), weights.texture.name(), meaning, out.target());
            EXPECT_LE(worst_difference(out, blend_neighbors(picture.pixels, expected_weights, meaning)), 1 / 255.0);
        }
        const MlaaSettings settings;
        const EdgeMap expected_edges = find_edges(picture.pixels, {}, settings.edges, {});
        passes_->edges(color.texture.name(), 0, settings.edges, {}, edges.target());
        EXPECT_EQ(read_edges(edges).cells, expected_edges.cells);
        passes_->mlaa_weights(edges.texture.name(), settings, weights.target());
        EXPECT_LE(worst_difference(weights, blush::mlaa_weights(expected_edges, settings)), 0);
    }
}

TEST_F(AntialiasPassesTest, FindEdgesOfEverySourceAsTheirTwin) {
    const gl::StateGuard guard;
    for (const NamedPicture& picture : test::antialias_pictures()) {
        SCOPED_TRACE(picture.name);
        const Surface color = upload(picture.pixels, GL_RGBA32F);
        DepthPixels depth(color.width, color.height);
        for (std::size_t i = 0; i < depth.cells.size(); ++i) depth.cells[i] = 0.5F + picture.pixels.cells[i].g * 0.1F;
        const Surface depth_surface = upload(depth);
        const Surface edges(color.width, color.height, GL_RG8);
        for (const EdgeSource source : {EdgeSource::luma, EdgeSource::color, EdgeSource::depth}) {
            for (const AlphaMeaning alpha :
                 {AlphaMeaning::carried, AlphaMeaning::straight, AlphaMeaning::premultiplied}) {
                for (const bool on : {false, true}) {
                    EdgeSettings settings;
                    settings.source = source;
                    settings.predication.on = on;
                    const PictureMeaning meaning{on ? Transfer::linear : Transfer::srgb, alpha, true};
                    passes_->edges(color.texture.name(), depth_surface.texture.name(), settings, meaning,
                                   edges.target());
                    EXPECT_EQ(read_edges(edges).cells, find_edges(picture.pixels, depth, settings, meaning).cells)
                        << static_cast<int>(source) << static_cast<int>(alpha) << on;
                }
            }
        }
    }
}

}  // namespace
}  // namespace blush
