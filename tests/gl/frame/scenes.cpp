// Scenes: several characters in one frame, several views of it, and how both go together with a host's framebuffer.

#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <filesystem>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/draw/face_model.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

/// A framebuffer as an engine has it: colour, a second colour attachment, depth.
class HostFramebuffer {
public:
    explicit HostFramebuffer(GLenum depth_format = GL_DEPTH24_STENCIL8, GLsizei samples = 1) : samples_(samples) {
        for (GLenum i = 0; i < 2; ++i) attach(colours_[i], GL_COLOR_ATTACHMENT0 + i, GL_RGBA8);
        const bool stencil = depth_format == GL_DEPTH24_STENCIL8 || depth_format == GL_DEPTH32F_STENCIL8;
        attach(depth_, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, depth_format);
        const std::array<GLenum, 2> both = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        glNamedFramebufferDrawBuffers(name(), 2, both.data());
    }
    GLuint name() const { return framebuffer_.name(); }

    void clear(glm::vec4 colour, glm::vec4 second, float depth) const {
        glClearNamedFramebufferfv(name(), GL_COLOR, 0, &colour.x);
        glClearNamedFramebufferfv(name(), GL_COLOR, 1, &second.x);
        glClearNamedFramebufferfv(name(), GL_DEPTH, 0, &depth);
    }
    /// Depth of the left half.
    void wall(float depth) const {
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, side / 2, side);
        glClearNamedFramebufferfv(name(), GL_DEPTH, 0, &depth);
        glDisable(GL_SCISSOR_TEST);
    }
    std::vector<std::uint8_t> read(GLenum attachment) const {
        std::vector<std::uint8_t> bytes(std::size_t{4} * side * side);
        resolve(GL_COLOR_BUFFER_BIT, attachment);
        glNamedFramebufferReadBuffer(single_.name(), GL_COLOR_ATTACHMENT0);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, single_.name());
        glReadPixels(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        return bytes;
    }
    std::vector<float> depth() const {
        std::vector<float> values(std::size_t{side} * side);
        if (samples_ > 1) return values;
        glBindFramebuffer(GL_READ_FRAMEBUFFER, name());
        glReadPixels(0, 0, side, side, GL_DEPTH_COMPONENT, GL_FLOAT, values.data());
        glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
        return values;
    }

private:
    void attach(gl::Texture& texture, GLenum attachment, GLenum format) {
        texture = gl::make_texture(samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D);
        if (samples_ > 1) {
            glTextureStorage2DMultisample(texture.name(), samples_, format, side, side, GL_TRUE);
        } else {
            glTextureStorage2D(texture.name(), 1, format, side, side);
        }
        glNamedFramebufferTexture(name(), attachment, texture.name(), 0);
    }
    void resolve(GLbitfield what, GLenum attachment) const {
        if (!single_color_) {
            single_color_ = gl::make_texture(GL_TEXTURE_2D);
            glTextureStorage2D(single_color_.name(), 1, GL_RGBA8, side, side);
            glNamedFramebufferTexture(single_.name(), GL_COLOR_ATTACHMENT0, single_color_.name(), 0);
        }
        glNamedFramebufferReadBuffer(name(), attachment);
        glBlitNamedFramebuffer(name(), single_.name(), 0, 0, side, side, 0, 0, side, side, what, GL_NEAREST);
    }

    GLsizei samples_;
    gl::Framebuffer framebuffer_ = gl::make_framebuffer(), single_ = gl::make_framebuffer();
    std::array<gl::Texture, 2> colours_;
    gl::Texture depth_;
    mutable gl::Texture single_color_;
};

class Scenes : public test::GlTest {
protected:
    static FaceAsset asset_of(Face face) { return *FaceAsset::create(std::move(face)); }
    Character character_of(const FaceAsset& asset) const { return *Character::create(device_, asset); }
    Scene make_scene() const { return *Scene::create(device_); }
    View make_view() const { return *View::create(device_); }

    /// From the front, one sample a pixel.
    static ViewFrame frame_of(const FaceAsset& asset) {
        ViewFrame frame;
        frame.width = frame.height = side;
        frame.samples = 1;
        frame.camera = asset.framing(1).camera(1);
        return frame;
    }
    static glm::dmat4 moved(glm::dvec3 by) { return glm::translate(glm::dmat4(1), by); }
    /// Two faces and a light that comes from the side, so that one shadows the other.
    static Lighting lamp(LightKind kind = LightKind::directional) {
        LightSource light;
        light.kind = kind;
        light.direction_world = {-0.5F, -0.3F, -1};
        light.position_world = {1.5, 1, 4};
        light.reference_distance = 4;
        light.size = 0.05F;
        Lighting lighting;
        lighting.lights = {light};
        lighting.sky_radiance_linear = lighting.ground_radiance_linear = glm::vec3(0.1F);
        return lighting;
    }
    static Face face() { return test::make_face({.targets = 4, .normal_deltas = true}); }
};

std::size_t differing(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, int more_than = 0) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(int{a[i]} - int{b[i]}) > more_than ? 1U : 0U;
    return count;
}

TEST_F(Scenes, TheNearerOfTwoCharactersHidesTheOtherWhateverTheirOrder) {
    const FaceAsset asset = asset_of(face());
    const ViewFrame base = frame_of(asset);
    const Lighting lighting = lamp();
    std::vector<std::vector<std::uint8_t>> pictures;
    for (const bool near_first : {true, false}) {
        Character near = character_of(asset), far = character_of(asset);
        near.place(moved({0.4, 0, 0.8}));
        far.place(moved({-0.4, 0, -0.8}));
        Scene scene = make_scene();
        ASSERT_TRUE(scene.add(near_first ? near : far));
        ASSERT_TRUE(scene.add(near_first ? far : near));
        scene.set_lighting(lighting);
        View view = make_view();
        const Offscreen offscreen = make_offscreen(side, side);
        ViewFrame frame = base;
        frame.framebuffer = offscreen.view().framebuffer;
        frame.check_finite = true;
        const FrameReport& report = scene.draw(view, frame);
        EXPECT_FALSE(report.not_finite);
        EXPECT_FALSE(report.failure);
        ASSERT_EQ(report.characters.size(), 2U);
        pictures.push_back(offscreen.read().bytes);
    }
    EXPECT_LE(differing(pictures[0], pictures[1], 1), 0U) << "the order in which characters were added shows";

    // Where the nearer one stands the picture is that of it alone, but for the shadow that the other cannot cast on it.
    Character near = character_of(asset);
    near.place(moved({0.4, 0, 0.8}));
    Scene alone = make_scene();
    ASSERT_TRUE(alone.add(near));
    alone.set_lighting(lighting);
    View view = make_view();
    const Offscreen offscreen = make_offscreen(side, side);
    ViewFrame frame = base;
    frame.framebuffer = offscreen.view().framebuffer;
    alone.draw(view, frame);
    const std::vector<std::uint8_t> near_alone = offscreen.read().bytes;
    std::size_t of_near = 0, same = 0;
    for (std::size_t p = 0; p < near_alone.size(); p += 4) {
        if (near_alone[p] < 80) continue;  // the background
        ++of_near;
        bool equal = true;
        for (std::size_t c = 0; c < 3; ++c) equal &= std::abs(int{near_alone[p + c]} - int{pictures[0][p + c]}) <= 2;
        same += equal ? 1U : 0U;
    }
    ASSERT_GT(of_near, 200U);
    // The outline's diffusion sees another neighbour.
    EXPECT_GE(static_cast<double>(same), 0.93 * static_cast<double>(of_near));
}

TEST_F(Scenes, FurtherCharactersShareModelProgramsAndPasses) {
    const FaceAsset asset = asset_of(face());
    std::vector<Character> characters;
    Scene scene = make_scene();
    View view = make_view();
    const Offscreen offscreen = make_offscreen(side, side);
    ViewFrame frame = frame_of(asset);
    frame.framebuffer = offscreen.view().framebuffer;
    OrbitCamera orbit = asset.framing(1);
    orbit.distance *= 6;
    orbit.scene_radius *= 6;
    frame.camera = orbit.camera(1);
    std::size_t passes = 0;
    std::uint32_t switches = 0;
    for (const std::size_t count : {1U, 2U, 5U, 20U}) {
        while (characters.size() < count) {
            characters.push_back(character_of(asset));
            const auto index = static_cast<double>(characters.size());
            characters.back().place(moved({2.2 * std::fmod(index, 5) - 4.4, 2.2 * std::floor(index / 5) - 4, 0}));
            ASSERT_TRUE(scene.add(characters.back()));
        }
        for (Character& character : characters) character.controls()[0] = 0.1F * static_cast<float>(count);
        const FrameReport& report = scene.draw(view, frame);
        ASSERT_FALSE(report.failure) << *report.failure;
        std::uint32_t stream_outs = 0, draws = 0;
        for (const CharacterReport& each : report.characters) {
            EXPECT_GT(each.draws, 0U);
            EXPECT_GT(each.triangles_drawn, 0U);
            stream_outs += each.stream_outs;
            draws += each.draws;
        }
        EXPECT_EQ(stream_outs, count);
        EXPECT_EQ(draws, report.draws);
        if (count == 1) {
            passes = report.passes.size();
            switches = report.program_switches;
        }
        EXPECT_EQ(report.passes.size(), passes) << count;
        EXPECT_EQ(report.program_switches, switches) << count;
        if (count > 1) {
            EXPECT_EQ(characters[0].state().model, characters[count - 1].state().model);
        }
    }
}

TEST_F(Scenes, PassesAndProgramsOfWholeHeadsDoNotGrowWithTheirNumber) {
    const FaceAsset asset = *FaceAsset::load(std::filesystem::path(BLUSH_BINARY_DIR) / "assets/face.glb");
    OrbitCamera orbit = asset.framing(1);
    orbit.distance *= 4;
    orbit.scene_radius *= 4;
    const Offscreen offscreen = make_offscreen(32, 32);
    ViewFrame frame = offscreen.view();
    frame.camera = orbit.camera(1);
    for (const char* mode : {"view", "smaa_t2x"}) {
        std::size_t passes = 0;
        std::uint32_t switches = 0;
        for (const int count : {1, 3}) {
            std::vector<Character> characters;
            Scene scene = make_scene();
            View view = make_view();
            ASSERT_TRUE(view.set("antialiasing.mode", mode));
            ASSERT_TRUE(scene.set("shadows.size", "512"));
            for (int c = 0; c < count; ++c) {
                characters.push_back(character_of(asset));
                characters.back().place(moved({0.2 * c - 0.2, 0, 0}));
                ASSERT_TRUE(scene.add(characters.back()));
            }
            for (const float value : {0.2F, 0.6F}) {  // the second frame has velocities
                for (Character& character : characters) std::ranges::fill(character.controls(), value);
                scene.draw(view, frame);
            }
            const FrameReport& report = Scene::report(view);
            if (count == 1) {
                passes = report.passes.size();
                switches = report.program_switches;
            }
            EXPECT_EQ(report.passes.size(), passes) << mode;
            // What blends is drawn from far to near, whatever its program.
            EXPECT_LE(report.program_switches, switches + 2 * static_cast<std::uint32_t>(count - 1)) << mode;
        }
    }
}

TEST_F(Scenes, SeveralViewsShareOneDeformationAndOneShadowPass) {
    const FaceAsset asset = asset_of(face());
    Character character = character_of(asset);
    Scene scene = make_scene();
    ASSERT_TRUE(scene.add(character));
    scene.set_lighting(lamp());
    View left = make_view(), right = make_view();
    const Offscreen on_left = make_offscreen(side, side), on_right = make_offscreen(side, side);
    ViewFrame a = frame_of(asset), b = frame_of(asset);
    a.framebuffer = on_left.view().framebuffer;
    b.framebuffer = on_right.view().framebuffer;
    OrbitCamera other = asset.framing(1);
    other.yaw_radians = 0.4F;
    b.camera = other.camera(1);
    character.controls()[1] = 0.7F;
    const std::array<ViewInFrame, 2> both = {{{left, a}, {right, b}}};
    scene.draw(both);
    const auto ran = [](const FrameReport& report, std::string_view name) {
        return std::ranges::any_of(report.passes,
                                   [name](const PassReport& pass) { return pass.name == name && pass.ran; });
    };
    EXPECT_TRUE(ran(Scene::report(left), "deform"));
    EXPECT_TRUE(ran(Scene::report(left), "shadow maps"));
    EXPECT_FALSE(ran(Scene::report(right), "deform"));
    EXPECT_FALSE(ran(Scene::report(right), "shadow maps"));

    // What the second view shows is what it shows alone.
    const std::vector<std::uint8_t> second = on_right.read().bytes;
    Scene fresh = make_scene();
    ASSERT_TRUE(fresh.add(character));
    fresh.set_lighting(lamp());
    View alone = make_view();
    fresh.draw(alone, b);
    EXPECT_EQ(on_right.read().bytes, second);
}

TEST_F(Scenes, APictureIsLaidOverTheHostsInItsRectangleAndSparesItsOtherAttachment) {
    const FaceAsset asset = asset_of(face());
    Character character = character_of(asset);
    Scene scene = make_scene();
    ASSERT_TRUE(scene.add(character));
    View view = make_view();
    for (const GLsizei samples : {1, 4}) {
        const HostFramebuffer host(GL_DEPTH24_STENCIL8, samples);
        const glm::vec4 green(0, 1, 0, 1), second(0.2F, 0.4F, 0.6F, 0.8F);
        host.clear(green, second, 1);
        const std::vector<std::uint8_t> before = host.read(GL_COLOR_ATTACHMENT0);
        const std::vector<std::uint8_t> second_before = host.read(GL_COLOR_ATTACHMENT1);
        ViewFrame frame = frame_of(asset);
        frame.framebuffer = host.name();
        frame.backdrop = Backdrop::keep;
        frame.x = 16;
        frame.y = 8;
        frame.width = frame.height = 32;
        const FrameReport& report = scene.draw(view, frame);
        ASSERT_FALSE(report.failure) << *report.failure;
        const std::vector<std::uint8_t> after = host.read(GL_COLOR_ATTACHMENT0);
        std::size_t face_pixels = 0;
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::size_t p = 4 * (std::size_t{y} * side + x);
                const bool inside = x >= 16 && x < 48 && y >= 8 && y < 40;
                const bool same = std::equal(&after[p], &after[p] + 4, &before[p]);
                if (!inside) {
                    ASSERT_TRUE(same) << x << ", " << y;
                } else if (!same) {
                    ++face_pixels;
                }
            }
        }
        EXPECT_GT(face_pixels, 200U);
        EXPECT_LT(face_pixels, 32U * 32U) << "the host's colour shows beside the face";
        EXPECT_EQ(host.read(GL_COLOR_ATTACHMENT1), second_before);
    }
}

/// A way in which a host has its depth.
struct HostsDepth {
    GLenum format;
    GLsizei samples = 1;
    DepthConvention convention;
    bool infinite = false;  ///< the far plane
};

std::vector<HostsDepth> ways_of_depth() {
    std::vector<HostsDepth> ways;
    for (const GLenum format : std::array<GLenum, 5>{GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH24_STENCIL8,
                                                     GL_DEPTH_COMPONENT32F, GL_DEPTH32F_STENCIL8}) {
        for (const bool zero_to_one : {false, true}) {
            for (const bool reversed : {false, true}) ways.push_back({format, 1, {zero_to_one, reversed}});
        }
        ways.push_back({format, 4, {true, true}});
        ways.push_back({format, 1, {true, true}, true});
    }
    return ways;
}

/// What GL's own projection becomes in the host's convention.
glm::mat4 projection_for(glm::mat4 clip, const HostsDepth& way) {
    if (way.infinite) {
        const float near = clip[3][2] / (clip[2][2] - 1);
        clip[2][2] = -1;
        clip[3][2] = -2 * near;
    }
    for (glm::length_t c = 0; c < 4; ++c) {
        if (way.convention.reversed) clip[c][2] = -clip[c][2];
        if (way.convention.zero_to_one) clip[c][2] = 0.5F * (clip[c][2] + clip[c][3]);
    }
    return clip;
}

TEST_F(Scenes, TheHostsDepthHidesTheFaceAndTheFacesDepthHidesTheHostsLaterGeometry) {
    const FaceAsset asset = asset_of(face());
    Character character = character_of(asset);
    Scene scene = make_scene();
    ASSERT_TRUE(scene.add(character));
    View view = make_view();
    for (const HostsDepth& way : ways_of_depth()) {
        SCOPED_TRACE(testing::Message() << way.format << ", " << way.samples << " samples, "
                                        << way.convention.zero_to_one << way.convention.reversed << way.infinite);
        const HostFramebuffer host(way.format, way.samples);
        const bool reversed = way.convention.reversed;
        const float far_depth = reversed ? 0.0F : 1.0F, near_depth = 1 - far_depth;
        host.clear({0, 1, 0, 1}, {}, far_depth);
        host.wall(near_depth);
        ViewFrame frame = frame_of(asset);
        frame.framebuffer = host.name();
        frame.backdrop = Backdrop::keep;
        frame.host_depth = HostDepth::read_and_write;
        frame.depth_convention = way.convention;
        frame.camera.clip_from_view = projection_for(frame.camera.clip_from_view, way);
        const FrameReport& report = scene.draw(view, frame);
        ASSERT_FALSE(report.failure) << *report.failure;
        const std::vector<std::uint8_t> picture = host.read(GL_COLOR_ATTACHMENT0);
        const std::vector<float> depth = host.depth();
        std::size_t faces = 0, written = 0;
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::size_t p = std::size_t{y} * side + x;
                const bool green = picture[4 * p] == 0 && picture[4 * p + 1] == 255;
                if (x < side / 2) {
                    ASSERT_TRUE(green) << "the wall hides the face at " << x << ", " << y;
                }
                if (x >= side / 2) faces += green ? 0U : 1U;
                if (way.samples > 1) continue;  // its depth cannot be read back
                if (x < side / 2) {
                    ASSERT_EQ(depth[p], near_depth);
                    continue;
                }
                written += depth[p] != far_depth ? 1U : 0U;
                if (!green) {
                    ASSERT_TRUE(reversed ? depth[p] > far_depth : depth[p] < far_depth) << x << ", " << y;
                }
            }
        }
        EXPECT_GT(faces, 300U);
        EXPECT_GE(faces, written);
    }
}

TEST_F(Scenes, OutputIsPremultipliedAndNothingStaysNothing) {
    const FaceAsset asset = asset_of(face());
    Character character = character_of(asset);
    Scene scene = make_scene();
    ASSERT_TRUE(scene.add(character));
    for (const Output output : {Output::display_srgb, Output::linear_hdr}) {
        View view = make_view();
        const Offscreen offscreen = make_offscreen(side, side, output);
        ViewFrame frame = frame_of(asset);
        frame.framebuffer = offscreen.view().framebuffer;
        frame.output = output;
        frame.background_linear = {0, 0, 1, 0};
        OrbitCamera orbit = asset.framing(1);
        orbit.distance *= 1.6F;
        frame.camera = orbit.camera(1);
        scene.draw(view, frame);
        const Image clear = offscreen.read();
        frame.background_linear = {0, 0, 1, 0.5F};
        scene.draw(view, frame);
        const Image half = offscreen.read();
        frame.background_linear.a = 1;
        scene.draw(view, frame);
        const Image whole = offscreen.read();
        if (output == Output::display_srgb) {
            EXPECT_EQ(clear.bytes[2], 0);
            EXPECT_EQ(clear.bytes[3], 0);
            EXPECT_NEAR(half.bytes[3], 128, 1);
            EXPECT_EQ(whole.bytes[3], 255);
            EXPECT_NEAR(half.bytes[2], whole.bytes[2] / 2.0, 1) << "encoded first, weighed with its opacity then";
        } else {
            EXPECT_EQ(clear.floats[2], 0);
            EXPECT_EQ(clear.floats[3], 0);
            EXPECT_NEAR(half.floats[2], 0.5F, 1e-3F);
            EXPECT_NEAR(half.floats[3], 0.5F, 1e-3F);
            EXPECT_NEAR(whole.floats[2], 1, 1e-3F);
        }
    }
}

/// Farthest channel of two pictures, of 255.
int worst_difference(const Image& a, const Image& b) {
    int worst = 0;
    for (std::size_t i = 0; i < a.bytes.size(); ++i)
        worst = std::max(worst, std::abs(int{a.bytes[i]} - int{b.bytes[i]}));
    return worst;
}

class Places : public Scenes, public testing::WithParamInterface<std::string_view> {};

/// Two frames of a scene that stands `place` away from the origin: the second one has moved, for temporal modes.
Image frame_at(const Device& device, const FaceAsset& asset, const std::string& mode, const Lighting& lighting,
               glm::dvec3 place) {
    Character character = *Character::create(device, asset);
    Scene scene = *Scene::create(device);
    EXPECT_TRUE(scene.add(character));
    View view = *View::create(device);
    EXPECT_TRUE(view.set("antialiasing.mode", mode));
    Lighting moved = lighting;
    for (LightSource& light : moved.lights) light.position_world += place;
    scene.set_lighting(moved);
    character.place(glm::translate(glm::dmat4(1), place));
    const Offscreen offscreen = *Offscreen::create(device, side, side, Output::display_srgb);
    ViewFrame frame = offscreen.view();
    frame.samples = 4;
    OrbitCamera orbit = asset.framing(1);
    orbit.target_world += place;
    for (const float yaw : {0.0F, 0.02F}) {
        orbit.yaw_radians = 0.3F + yaw;
        frame.camera = orbit.camera(1);
        character.controls()[0] = 0.3F + yaw;
        scene.draw(view, frame);
    }
    return offscreen.read();
}

TEST_P(Places, DoNotMatterUnderAnyKindOfLight) {
    const FaceAsset asset = asset_of(face());
    std::vector<Lighting> lightings;
    for (const LightKind kind : {LightKind::directional, LightKind::point, LightKind::spot}) {
        lightings.push_back(lamp(kind));
    }
    for (const Lighting& lighting : lightings) {
        const Image at_origin = frame_at(device_, asset, std::string(GetParam()), lighting, glm::dvec3(0));
        ASSERT_GT(test::colour_count(at_origin), test::fewest_colours);
        for (const double far : {3.0, 100.0, 1e4, 1e6}) {
            const Image there = frame_at(device_, asset, std::string(GetParam()), lighting, {far, -far, 0.5 * far});
            EXPECT_LE(worst_difference(at_origin, there), 2)
                << far << " units away, light of kind " << static_cast<int>(lighting.lights[0].kind);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EveryMode, Places, testing::ValuesIn(antialiasing_modes),
                         [](const auto& mode) { return std::string(mode.param); });

TEST_F(Scenes, LightOfOnesSkinNeverReachesAnothers) {
    const FaceAsset asset = asset_of(test::make_face({.targets = 0}));
    // Side by side at one depth, so that only the number of the character tells their skins apart.
    Character lit = character_of(asset), dark = character_of(asset);
    lit.place(moved({-1.02, 0, 0}));
    dark.place(moved({1.02, 0, 0}));
    LightSource lamp;
    lamp.kind = LightKind::spot;
    lamp.position_world = {-1.1, 0, 4};
    lamp.direction_world = {0, 0, -1};
    lamp.reference_distance = 4;
    lamp.radiance_linear = glm::vec3(3);
    lamp.inner_radians = 0.1F;
    lamp.outer_radians = 0.2F;
    Lighting lighting;
    lighting.lights = {lamp};
    const Offscreen offscreen = make_offscreen(128, 64, Output::linear_hdr);
    OrbitCamera orbit = asset.framing(2);
    orbit.distance *= 1.1F;
    ViewFrame frame = offscreen.view();
    frame.camera = orbit.camera(2);
    frame.samples = 1;
    frame.background_linear = {0, 0, 0, 1};
    for (const char* method : {"separable", "gaussians4", "gaussians6", "jittered"}) {
        for (const bool other_width : {false, true}) {
            ASSERT_TRUE(dark.set("scattering.width", other_width ? "3" : "1.12"));
            for (Character* each : {&lit, &dark}) {
                // A wide kernel: some hundred millimetres.
                ASSERT_TRUE(each->set("scattering.millimetres_a_unit", "20"));
            }
            const auto picture = [&](std::initializer_list<const Character*> of) {
                Scene scene = make_scene();
                for (const Character* each : of) EXPECT_TRUE(scene.add(*each));
                scene.set_lighting(lighting);
                EXPECT_TRUE(scene.set("shadows.method", "off"));
                View view = make_view();
                EXPECT_TRUE(view.set("scattering.method", method));
                const FrameReport& report = scene.draw(view, frame);
                EXPECT_FALSE(report.failure) << *report.failure;
                return offscreen.read();
            };
            const Image alone = picture({&dark}), both = picture({&lit, &dark}), lamp_side = picture({&lit});
            float worst = 0, brightest = 0;
            for (std::uint32_t y = 0; y < 64; ++y) {
                for (std::uint32_t x = 0; x < 128; ++x) {
                    const std::size_t p = 4 * (std::size_t{y} * 128 + x);
                    brightest = std::max(brightest, lamp_side.floats[p]);
                    // Where the lit one does not stand.
                    if (x < 68 || lamp_side.floats[p] != 0) continue;
                    worst = std::max(worst, std::abs(both.floats[p] - alone.floats[p]));
                }
            }
            EXPECT_GT(brightest, 0.3F);
            EXPECT_LE(worst, 1e-3F) << method;
        }
    }
}

TEST_F(Scenes, ASettingIsSetOnItsOwner) {
    const FaceAsset asset = asset_of(face());
    Character character = character_of(asset);
    Scene scene = make_scene();
    View view = make_view();
    EXPECT_TRUE(character.set("scattering.width", "2"));
    EXPECT_TRUE(scene.set("shadows.size", "512"));
    EXPECT_TRUE(view.set("scattering.method", "off"));
    const Status wrong = character.set("antialiasing.mode", "smaa_1x");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message, "setting antialiasing.mode is the view's, not the character's");
    EXPECT_EQ(scene.set("blood.shown", "no").error().message,
              "setting blood.shown is the character's, not the scene's");
    EXPECT_EQ(view.set("shadows.size", "512").error().message, "setting shadows.size is the scene's, not the view's");
    EXPECT_FALSE(view.set("no.such", "thing"));
}

TEST_F(Scenes, ACharacterThatGoesLeavesTheScene) {
    const FaceAsset asset = asset_of(face());
    Scene scene = make_scene();
    View view = make_view();
    const Offscreen offscreen = make_offscreen(side, side);
    ViewFrame frame = frame_of(asset);
    frame.framebuffer = offscreen.view().framebuffer;
    const std::vector<std::uint8_t> empty = [&] {
        scene.draw(view, frame);
        return offscreen.read().bytes;
    }();
    {
        Character passing = character_of(asset);
        ASSERT_TRUE(scene.add(passing));
        ASSERT_TRUE(scene.add(passing)) << "a second time has no effect";
        EXPECT_EQ(scene.draw(view, frame).characters.size(), 1U);
        EXPECT_NE(offscreen.read().bytes, empty);
    }
    EXPECT_TRUE(scene.draw(view, frame).characters.empty());
    EXPECT_EQ(offscreen.read().bytes, empty);
    const Device other = make_device();
    const Character stranger = *Character::create(other, asset);
    EXPECT_EQ(scene.add(stranger).error().message, "the character is of another device than the scene");
}

TEST_F(Scenes, DepthForTheHostsShadowPassIsWhereTheFaceIs) {
    const FaceAsset asset = asset_of(face());
    Character character = character_of(asset);
    character.controls()[0] = 0.5F;
    Scene scene = make_scene();
    ASSERT_TRUE(scene.add(character));
    for (const bool reversed : {false, true}) {
        const HostFramebuffer host(GL_DEPTH_COMPONENT32F);
        const float far_depth = reversed ? 0.0F : 1.0F;
        host.clear({}, {}, far_depth);
        DepthFrame frame;
        frame.framebuffer = host.name();
        frame.width = frame.height = side;
        frame.depth_convention = {true, reversed};
        const Camera camera = asset.framing(1).camera(1);
        glm::dmat4 clip(camera.clip_from_view);
        for (glm::length_t c = 0; c < 4; ++c) {
            clip[c][2] = 0.5 * ((reversed ? -clip[c][2] : clip[c][2]) + clip[c][3]);
        }
        frame.clip_from_world = clip * camera.view_from_world;
        scene.draw_depth(frame);
        const std::vector<float> depth = host.depth();
        const auto covered =
            std::ranges::count_if(depth, [far_depth](float d) { return d != far_depth && d > 0 && d < 1; });
        EXPECT_GT(covered, 1000);
        EXPECT_EQ(depth[0], far_depth);
    }
}

TEST_F(Scenes, LightsWithoutNumberLightACharacterByThoseThatReachIt) {
    const FaceAsset asset = asset_of(face());
    Character character = character_of(asset);
    Scene scene = make_scene();
    ASSERT_TRUE(scene.add(character));
    Lighting lighting;
    for (int i = 0; i < 200; ++i) {
        LightSource light;
        light.kind = LightKind::point;
        light.casts_shadow = false;
        light.radiance_linear = glm::vec3(0.05F);
        light.reference_distance = 3;
        // Half of them near, half a thousand times as far.
        const double distance = i % 2 == 0 ? 3 : 3000;
        light.position_world = distance * glm::normalize(glm::dvec3(std::sin(i), std::cos(1.7 * i), 1.5));
        lighting.lights.push_back(light);
    }
    scene.set_lighting(lighting);
    View view = make_view();
    const Offscreen offscreen = make_offscreen(side, side);
    ViewFrame frame = frame_of(asset);
    frame.framebuffer = offscreen.view().framebuffer;
    const CharacterReport& report = scene.draw(view, frame).characters[0];
    EXPECT_EQ(report.lights, 64U);
    EXPECT_EQ(report.lights_left_out, 136U);
    EXPECT_GT(report.lights_left_out_radiance, 0);
    EXPECT_TRUE(std::isfinite(report.lights_left_out_radiance));
}

TEST_F(Scenes, JointsOfTheHostsMoveTheFace) {
    const FaceAsset asset = asset_of(test::make_face({.targets = 1, .joints = true}));
    Character character = character_of(asset);
    Scene scene = make_scene();
    ASSERT_TRUE(scene.add(character));
    const std::size_t joints = asset.state().joint_count;
    ASSERT_GT(joints, 0U);
    EXPECT_FALSE(character.set_joints(std::vector<glm::mat4>(joints + 1, glm::mat4(1))));
    const Offscreen offscreen = make_offscreen(side, side);
    ViewFrame frame = frame_of(asset);
    frame.framebuffer = offscreen.view().framebuffer;
    View view = make_view();
    scene.draw(view, frame);
    const std::vector<std::uint8_t> rest = offscreen.read().bytes;
    const glm::mat4 aside = glm::translate(glm::mat4(1), glm::vec3(0.5F, 0, 0));
    ASSERT_TRUE(character.set_joints(std::vector<glm::mat4>(joints, aside)));
    scene.draw(view, frame);
    const std::vector<std::uint8_t> moved_aside = offscreen.read().bytes;
    EXPECT_GT(differing(rest, moved_aside, 8), 300U);
    ASSERT_TRUE(character.set_joints({}));
    scene.draw(view, frame);
    EXPECT_EQ(offscreen.read().bytes, rest);
}

}  // namespace
}  // namespace blush
