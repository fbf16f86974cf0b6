// Pins: the border of the neck is where the host says, in every buffer and every pass that shows it.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/deform/rest_places.h"
#include "runtime/deform/pinned_surface.h"
#include "runtime/files/face_file.h"
#include "runtime/frame/character_state.h"
#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl/surface/surface_reading.h"
#include "tests/gl_fixture.h"
#include "tests/rig/count_allocations.h"
#include "tests/rotation.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

class Pins : public test::GlTest {
protected:
    static Face face(bool joints = false) {
        return test::make_face({.side = 24,
                                .targets = 8,
                                .normal_deltas = true,
                                .odd_without_normals = true,
                                .seam = true,
                                .joints = joints});
    }
    /// What a host's body does with its border in one pose.
    struct Body {
        std::vector<glm::vec3> positions, normals;
    };
    static Body body_of(const Face& face, std::span<const std::uint32_t> border, test::Random& random, float reach) {
        Body body;
        const glm::mat4 turn = glm::rotate(glm::mat4(1), random.between(-0.3F, 0.3F), glm::vec3(0, 1, 0));
        for (const std::uint32_t v : border) {
            const glm::vec3 wobble(random.between(-reach, reach), random.between(-reach, reach),
                                   random.between(-reach, reach));
            body.positions.push_back(glm::vec3(turn * glm::vec4(face.positions[v], 1)) + wobble);
            body.normals.push_back(glm::normalize(glm::mat3(turn) * face.normals[v] + wobble));
        }
        return body;
    }
    /// Targets alone: a turned head would turn the mesh's space against the file's.
    static std::span<float> targets(Character& character) {
        return character.controls().first(character.face().targets.size());
    }
    static double width_mm(const FaceAsset& asset, double units) {
        return units * asset.state().scale.millimetres_a_unit;
    }
    struct Stage {
        FaceAsset asset;
        Character character;
        Scene scene;
        std::vector<std::uint32_t> border;
    };
    Stage stage_of(Face its, double width_units) const {
        FaceAsset asset = *FaceAsset::create(std::move(its));
        Stage stage{asset, *Character::create(device_, asset), *Scene::create(device_), asset.neck_border()};
        EXPECT_FALSE(stage.border.empty());
        EXPECT_TRUE(stage.scene.add(stage.character));
        EXPECT_TRUE(stage.character.pin(stage.border, width_mm(asset, width_units)));
        return stage;
    }
    static const EffectReport* effect_of(const FrameReport& report, std::string_view name) {
        const auto found = std::ranges::find(report.effects, name, &EffectReport::effect);
        return found == report.effects.end() ? nullptr : &*found;
    }
};

TEST_F(Pins, HoldInAThousandPosesAndTouchNothingBeyondTheirWidth) {
    constexpr double width = 0.3;
    test::Random random(21);
    for (const bool joints : {false, true}) {
        Stage stage = stage_of(face(joints), width);
        Character& character = stage.character;
        Character free = *Character::create(device_, stage.asset);
        ASSERT_TRUE(stage.scene.add(free));
        const Face& its = character.face();
        const std::vector<glm::dvec3> places = rest_places(its, glm::dvec3(0));
        std::vector<std::uint8_t> beyond(places.size(), 1);
        for (std::size_t v = 0; v < places.size(); ++v) {
            for (const std::uint32_t b : stage.border) {
                if (glm::distance(places[v], places[b]) < width) beyond[v] = 0;
            }
        }
        ASSERT_GT(std::ranges::count(beyond, std::uint8_t{1}), 50);
        const glm::vec3 origin = joints ? glm::vec3(stage.asset.state().skinned_origin) : glm::vec3(0);
        double worst_normal = 0, widest = 0;
        const int poses = joints ? 200 : 1000;
        for (int pose = 0; pose < poses; ++pose) {
            for (std::size_t c = 0; c < targets(character).size(); ++c)
                character.controls()[c] = free.controls()[c] = pose % 50 == 0 ? 0 : random.between(-1, 1);
            if (joints) {
                std::vector<glm::mat4> skeleton(2);
                for (glm::mat4& joint : skeleton)
                    joint = glm::rotate(glm::mat4(1), random.between(-0.5F, 0.5F), glm::vec3(0, 1, 0));
                ASSERT_TRUE(character.set_joints(skeleton));
                ASSERT_TRUE(free.set_joints(skeleton));
            }
            const Body body = body_of(its, stage.border, random, 0.05F);
            ASSERT_TRUE(character.move_pins(body.positions, body.normals));
            stage.scene.deform();
            const Scene::Surface pinned = test::read_published(character.surface());
            const Scene::Surface own = test::read_published(free.surface());
            for (std::size_t i = 0; i < stage.border.size(); ++i) {
                const std::uint32_t b = stage.border[i];
                // Buffers of skinned faces have their origin near the face.
                const glm::vec3 expected(glm::dvec3(body.positions[i]) - glm::dvec3(origin));
                ASSERT_EQ(pinned.positions[b], expected) << "pose " << pose;
                worst_normal = std::max(worst_normal, glm::length(glm::dvec3(pinned.normals[b] - body.normals[i])));
                // The body's mesh and the neck share this vertex: whatever both draw it with, it is one place.
                widest = std::max(widest, glm::length(glm::dvec3(pinned.positions[b]) - glm::dvec3(expected)));
            }
            for (std::size_t v = 0; v < places.size(); ++v) {
                if (beyond[v] == 0) continue;
                ASSERT_EQ(pinned.positions[v], own.positions[v]) << "pose " << pose << ", vertex " << v;
                ASSERT_EQ(pinned.normals[v], own.normals[v]) << "pose " << pose << ", vertex " << v;
                ASSERT_EQ(pinned.tangents[v], own.tangents[v]) << "pose " << pose << ", vertex " << v;
            }
            for (std::size_t v = 0; v < places.size(); ++v)
                ASSERT_NEAR(glm::length(glm::dvec3(pinned.normals[v])), 1, 1e-5);
            // Copies across the seam went along.
            for (std::size_t v = 0; v < places.size(); ++v) {
                for (const std::uint32_t b : stage.border) {
                    if (its.positions[v] == its.positions[b]) {
                        ASSERT_EQ(pinned.positions[v], pinned.positions[b]);
                    }
                }
            }
        }
        EXPECT_LE(worst_normal, 1e-6);
        EXPECT_EQ(widest, 0);
    }
}

TEST_F(Pins, TheGpuAndTheCpuAgreeToTheBit) {
    Stage stage = stage_of(face(), 0.4);
    test::Random random(5);
    Character free = *Character::create(device_, stage.asset);
    ASSERT_TRUE(stage.scene.add(free));
    for (int pose = 0; pose < 50; ++pose) {
        for (std::size_t c = 0; c < free.controls().size(); ++c)
            stage.character.controls()[c] = free.controls()[c] = random.between(-1, 1);
        const Body body = body_of(stage.asset.face(), stage.border, random, 0.1F);
        ASSERT_TRUE(stage.character.move_pins(body.positions, body.normals));
        stage.scene.deform();
        const Scene::Surface own = test::read_published(free.surface());
        Scene::Surface twin = own;
        const PinnedSurface& pinned = *stage.character.state().pinned;
        apply_pins(pinned.ring, pinned.pins, {own.positions, own.normals, twin.positions, twin.normals, twin.tangents});
        const Scene::Surface gpu = test::read_published(stage.character.surface());
        ASSERT_EQ(gpu.positions, twin.positions);
        ASSERT_EQ(gpu.normals, twin.normals);
        ASSERT_EQ(gpu.tangents, twin.tangents);
    }
}

TEST_F(Pins, OfATurnedNodeStandWhereTheFilesSpaceHasThem) {
    Face its = face();
    its.nodes[0].rest.translation = {5, 1, -2};
    its.nodes[0].rest.rotation = rotation_of(glm::angleAxis(0.7F, glm::normalize(glm::vec3(1, 1, 0))));
    its.nodes[0].rest.scale = {2, 2, 1};
    Stage stage = stage_of(its, 0.6);
    const std::vector<glm::dvec3> places = rest_places(its, glm::dvec3(0));
    std::vector<glm::vec3> positions, normals;
    for (const std::uint32_t b : stage.border) {
        positions.push_back(glm::vec3(places[b]) + glm::vec3(0.1F, 0.2F, 0));
        normals.emplace_back(0, 0.6F, 0.8F);
    }
    ASSERT_TRUE(stage.character.move_pins(positions, normals));
    stage.character.set(*stage.character.control("headYaw"), 0.4F);
    stage.scene.deform();
    const PublishedSurface published = stage.character.surface();
    const Scene::Surface surface = test::read_published(published);
    const glm::dmat4& world = published.primitives[0].world_from_mesh;
    const glm::dmat3 normal_from_mesh = glm::transpose(glm::inverse(glm::dmat3(world)));
    for (std::size_t i = 0; i < stage.border.size(); ++i) {
        const glm::dvec3 there(world * glm::dvec4(surface.positions[stage.border[i]], 1));
        EXPECT_LT(glm::length(there - glm::dvec3(positions[i])), 2e-6);
        const glm::dvec3 up = glm::normalize(normal_from_mesh * glm::dvec3(surface.normals[stage.border[i]]));
        EXPECT_LT(glm::length(up - glm::dvec3(normals[i])), 1e-6);
    }
}

TEST_F(Pins, AreLeftOutExactlyWhereNothingIsPinned) {
    const FaceAsset asset = *FaceAsset::create(face());
    Character character = *Character::create(device_, asset);
    Scene scene = *Scene::create(device_);
    ASSERT_TRUE(scene.add(character));
    View view = *View::create(device_);
    const Offscreen offscreen = make_offscreen(side, side);
    ViewFrame frame = offscreen.view();
    frame.camera = asset.framing(1).camera(1);
    for (float& control : character.controls()) control = 0.3F;
    const auto draw = [&]() -> const FrameReport& { return scene.draw(view, frame); };
    EXPECT_FALSE(effect_of(draw(), "pinning")->on);
    const std::vector<std::uint8_t> before = offscreen.read().bytes;
    frame.force_effects = true;
    EXPECT_FALSE(effect_of(draw(), "pinning")->on) << "it cannot be forced";
    frame.force_effects = false;

    const std::vector<std::uint32_t> border = asset.neck_border();
    ASSERT_TRUE(character.pin(border, width_mm(asset, 0.3)));
    EXPECT_FALSE(effect_of(draw(), "pinning")->on) << "nobody said where yet";
    EXPECT_EQ(offscreen.read().bytes, before);

    test::Random random(3);
    Body body = body_of(asset.face(), border, random, 0.1F);
    ASSERT_TRUE(character.move_pins(body.positions, body.normals));
    EXPECT_TRUE(effect_of(draw(), "pinning")->on);
    const std::vector<std::uint8_t> pinned = offscreen.read().bytes;
    EXPECT_NE(pinned, before);
    const FrameReport& again = draw();
    EXPECT_FALSE(effect_of(again, "pinning")->on) << "what an earlier frame made still stands";
    EXPECT_EQ(effect_of(again, "pinning")->omission, Omission::exact);
    EXPECT_EQ(offscreen.read().bytes, pinned);
    frame.force_effects = true;
    EXPECT_TRUE(effect_of(draw(), "pinning")->on);
    EXPECT_EQ(offscreen.read().bytes, pinned) << "forced or left out: the same bits";
    frame.force_effects = false;

    // What is not finite is not pinned.
    for (glm::vec3& position : body.positions) position.y = NAN;
    ASSERT_TRUE(character.move_pins(body.positions, body.normals));
    EXPECT_FALSE(effect_of(draw(), "pinning")->on);
    EXPECT_EQ(offscreen.read().bytes, before);
    ASSERT_TRUE(character.pin({}, 0));
    draw();
    EXPECT_EQ(offscreen.read().bytes, before);
}

TEST_F(Pins, ThatAreNotFiniteLeaveTheirVertexToItself) {
    Stage stage = stage_of(face(), 0.3);
    test::Random random(8);
    Body body = body_of(stage.asset.face(), stage.border, random, 0.05F);
    body.positions[3].x = NAN;
    body.positions[5].z = INFINITY;
    body.normals[7] = glm::vec3(0);
    body.normals[9].y = NAN;
    for (float& weight : targets(stage.character)) weight = 0.5F;
    ASSERT_TRUE(stage.character.move_pins(body.positions, body.normals));
    stage.scene.deform();
    const Scene::Surface pinned = test::read_published(stage.character.surface());
    Character free = *Character::create(device_, stage.asset);
    ASSERT_TRUE(stage.scene.add(free));
    for (float& weight : targets(free)) weight = 0.5F;
    stage.scene.deform();
    const Scene::Surface own = test::read_published(free.surface());
    for (std::size_t i = 0; i < stage.border.size(); ++i) {
        const std::uint32_t b = stage.border[i];
        const bool bad = i == 3 || i == 5 || i == 7 || i == 9;
        EXPECT_EQ(pinned.positions[b], bad ? own.positions[b] : body.positions[i]) << i;
    }
    for (std::size_t v = 0; v < pinned.positions.size(); ++v) {
        ASSERT_TRUE(std::isfinite(glm::dot(pinned.positions[v], pinned.positions[v])));
        ASSERT_NEAR(glm::length(glm::dvec3(pinned.normals[v])), 1, 1e-5);
        ASSERT_NEAR(glm::length(glm::dvec3(pinned.tangents[v])), 1, 1e-5);
    }
}

TEST_F(Pins, ReachDepthShadowsVelocitiesAndWhatIsReadBack) {
    Stage stage = stage_of(face(), 0.5);
    Character& character = stage.character;
    const std::vector<float> no_depth(std::size_t{side} * side, 1);
    const auto depth = [&] {
        gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
        glTextureStorage2D(texture.name(), 1, GL_DEPTH_COMPONENT32F, side, side);
        const gl::Framebuffer framebuffer = gl::make_framebuffer();
        glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, texture.name(), 0);
        const float far_depth = 1;
        glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &far_depth);
        DepthFrame frame;
        const Camera camera = stage.asset.framing(1).camera(1);
        frame.clip_from_world = glm::dmat4(camera.clip_from_view) * camera.view_from_world;
        frame.width = frame.height = side;
        frame.framebuffer = framebuffer.name();
        stage.scene.draw_depth(frame);
        std::vector<float> values(no_depth.size());
        glGetTextureImage(texture.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                          static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
        return values;
    };
    LightSource light;
    light.direction_world = {-0.5F, -0.3F, -1};
    Lighting lighting;
    lighting.lights = {light};
    stage.scene.set_lighting(lighting);
    View view = *View::create(device_);
    ASSERT_TRUE(view.set("antialiasing.mode", "smaa_t2x"));
    const Offscreen offscreen = make_offscreen(side, side);
    ViewFrame frame = offscreen.view();
    frame.camera = stage.asset.framing(1).camera(1);
    const auto ran = [](const FrameReport& report, std::string_view name) {
        return std::ranges::any_of(report.passes,
                                   [name](const PassReport& pass) { return pass.name == name && pass.ran; });
    };
    test::Random random(13);
    const std::vector<float> free_depth = depth();
    for (int still = 0; still < 3; ++still) stage.scene.draw(view, frame);
    EXPECT_FALSE(ran(Scene::report(view), "velocities")) << "nothing moves";
    EXPECT_FALSE(ran(Scene::report(view), "shadow maps"));

    const Body body = body_of(stage.asset.face(), stage.border, random, 0.1F);
    ASSERT_TRUE(character.move_pins(body.positions, body.normals));
    const FrameReport& moved = stage.scene.draw(view, frame);
    EXPECT_TRUE(ran(moved, "pin"));
    EXPECT_TRUE(ran(moved, "velocities")) << "only pins moved";
    EXPECT_TRUE(ran(moved, "shadow maps"));
    EXPECT_NE(depth(), free_depth);
    const Scene::Surface read = stage.scene.read_deformed(character);
    for (std::size_t i = 0; i < stage.border.size(); ++i) EXPECT_EQ(read.positions[stage.border[i]], body.positions[i]);
    // The next frame compares itself with the pinned surface.
    std::vector<glm::vec3> last(read.positions.size());
    glGetNamedBufferSubData(character.state().last.positions.name(), 0,
                            static_cast<GLsizeiptr>(last.size() * sizeof(glm::vec3)), last.data());
    EXPECT_EQ(last, read.positions);
    const FrameReport& after = stage.scene.draw(view, frame);
    EXPECT_FALSE(ran(after, "velocities"));
    EXPECT_FALSE(ran(after, "shadow maps"));

    // Pinned anew at other places, and let go: each is a move.
    ASSERT_TRUE(character.pin(stage.border, width_mm(stage.asset, 0.5)));
    const Body other = body_of(stage.asset.face(), stage.border, random, 0.1F);
    ASSERT_TRUE(character.move_pins(other.positions, other.normals));
    EXPECT_TRUE(ran(stage.scene.draw(view, frame), "velocities"));
    ASSERT_TRUE(character.pin({}, 0));
    EXPECT_EQ(character.surface().positions.name, 0U) << "what was published of them went with them";
    const FrameReport& free = stage.scene.draw(view, frame);
    EXPECT_TRUE(ran(free, "velocities"));
    EXPECT_TRUE(ran(free, "shadow maps"));
    EXPECT_EQ(depth(), free_depth);
}

/// A host's body in plain GL: a collar around the border, drawn into a depth buffer.
class Collar {
public:
    Collar() {
        const char* text = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 0) uniform mat4 clip_from_world;
out gl_PerVertex { vec4 gl_Position; };
void main() { gl_Position = clip_from_world * vec4(position, 1.0); }
)";
        program_ = glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &text);
        glCreateProgramPipelines(1, &pipeline_);
        glUseProgramStages(pipeline_, GL_VERTEX_SHADER_BIT, program_);
    }
    ~Collar() {
        glDeleteProgramPipelines(1, &pipeline_);
        glDeleteProgram(program_);
    }
    Collar(const Collar&) = delete;
    Collar& operator=(const Collar&) = delete;

    void draw(const std::vector<glm::vec3>& border, const glm::mat4& clip_from_world, GLuint framebuffer) const {
        const auto outer = [](const glm::vec3& inner) {
            return inner + 0.5F * glm::normalize(glm::vec3(inner.x, inner.y, 0));
        };
        std::vector<glm::vec3> triangles;
        for (std::size_t i = 0; i < border.size(); ++i) {
            const glm::vec3 &a = border[i], &b = border[(i + 1) % border.size()];
            triangles.insert(triangles.end(), {a, b, outer(a), b, outer(b), outer(a)});
        }
        const gl::Buffer vertices = gl::make_buffer<glm::vec3>(triangles);
        const gl::VertexArray array = gl::make_vertex_array();
        glVertexArrayVertexBuffer(array.name(), 0, vertices.name(), 0, sizeof(glm::vec3));
        glEnableVertexArrayAttrib(array.name(), 0);
        glVertexArrayAttribFormat(array.name(), 0, 3, GL_FLOAT, GL_FALSE, 0);
        glBindVertexArray(array.name());
        glUseProgram(0);
        glBindProgramPipeline(pipeline_);
        glProgramUniformMatrix4fv(program_, 0, 1, GL_FALSE, &clip_from_world[0].x);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(0, 0, side, side);
        glEnable(GL_DEPTH_TEST);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
        glDisable(GL_DEPTH_TEST);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glBindProgramPipeline(0);
        glBindVertexArray(0);
    }

private:
    GLuint program_ = 0, pipeline_ = 0;
};

TEST_F(Pins, NothingShowsThroughTheSeamInAThousandPoses) {
    Face both_sides = face();  // a border that wobbles may turn a triangle away
    for (Material& material : both_sides.materials) material.double_sided = true;
    Stage stage = stage_of(std::move(both_sides), 0.5);
    const gl::Texture depth = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(depth.name(), 1, GL_DEPTH_COMPONENT32F, side, side);
    const gl::Framebuffer framebuffer = gl::make_framebuffer();
    glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
    glNamedFramebufferDrawBuffer(framebuffer.name(), GL_NONE);
    const Camera camera = stage.asset.framing(1).camera(1);
    DepthFrame frame;
    frame.clip_from_world = glm::dmat4(camera.clip_from_view) * camera.view_from_world;
    frame.width = frame.height = side;
    frame.framebuffer = framebuffer.name();
    const glm::mat4 clip(frame.clip_from_world);
    const Collar collar;
    test::Random random(31);
    std::vector<float> values(std::size_t{side} * side);
    /// Pixels of the seam through which nothing is seen but the background.
    const auto holes = [&](const std::vector<glm::vec3>& border) {
        const float far_depth = 1;
        glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &far_depth);
        stage.scene.draw_depth(frame);
        collar.draw(border, clip, framebuffer.name());
        glGetTextureImage(depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                          static_cast<GLsizei>(values.size() * sizeof(float)), values.data());
        std::size_t open = 0;
        for (std::size_t i = 0; i < border.size(); ++i) {
            for (const float t : {0.0F, 0.25F, 0.5F, 0.75F}) {
                const glm::vec4 at = clip * glm::vec4(glm::mix(border[i], border[(i + 1) % border.size()], t), 1);
                const glm::vec2 pixel = (glm::vec2(at) / at.w * 0.5F + 0.5F) * static_cast<float>(side);
                const auto x = static_cast<std::size_t>(std::clamp(pixel.x, 0.0F, static_cast<float>(side - 1)));
                const auto y = static_cast<std::size_t>(std::clamp(pixel.y, 0.0F, static_cast<float>(side - 1)));
                open += values[y * side + x] == 1 ? 1U : 0U;
            }
        }
        return open;
    };
    std::size_t without_pins = 0;
    for (int pose = 0; pose < 1000; ++pose) {
        for (float& target : targets(stage.character)) target = random.between(0, 1);
        const Body body = body_of(stage.asset.face(), stage.border, random, 0.03F);
        ASSERT_TRUE(stage.character.move_pins(body.positions, body.normals));
        ASSERT_EQ(holes(body.positions), 0U) << "pose " << pose;
        if (pose % 100 != 0) continue;
        ASSERT_TRUE(stage.character.pin({}, 0));
        without_pins += holes(body.positions);
        ASSERT_TRUE(stage.character.pin(stage.border, width_mm(stage.asset, 0.5)));
    }
    EXPECT_GT(without_pins, 20U) << "the seam would be closed anyway";
}

TEST_F(Pins, ThatCannotBeAreRefusedInOneSentence) {
    const FaceAsset asset = *FaceAsset::create(face());
    Character character = *Character::create(device_, asset);
    const std::vector<std::uint32_t> beyond = {0, 100000};
    EXPECT_EQ(character.pin(beyond, 10).error().message, "test_face: vertex 100000 cannot be pinned: no node draws it");
    const std::vector<std::uint32_t> one = {0};
    EXPECT_FALSE(character.pin(one, NAN));
    EXPECT_EQ(character.pin(one, -1).error().message,
              "test_face: the width of pinning is -1.000000 mm; it must be finite and not below 0");
    ASSERT_TRUE(character.pin(one, 0));
    const std::vector<glm::vec3> two(2);
    EXPECT_EQ(character.move_pins(two, two).error().message,
              "test_face: 2 positions and 2 normals given for pins; 1 vertices are pinned");
    EXPECT_FALSE(Character(*Character::create(device_, asset)).move_pins(two, two));
}

TEST_F(Pins, CostNoMemoryInASteadyFrame) {
    Stage stage = stage_of(face(true), 0.3);
    test::Random random(2);
    const Body body = body_of(stage.asset.face(), stage.border, random, 0.05F);
    Body moving = body;
    const auto draw = [&](int number) {
        for (glm::vec3& position : moving.positions) position.x += 0.001F;
        for (float& control : stage.character.controls()) control = 0.1F + 0.01F * static_cast<float>(number);
        ASSERT_TRUE(stage.character.move_pins(moving.positions, moving.normals));
        stage.scene.deform();
    };
    for (int warm = 0; warm < 4; ++warm) draw(warm);
    const std::size_t before = test::allocation_count();
    for (int steady = 4; steady < 8; ++steady) draw(steady);
    EXPECT_EQ(test::allocation_count(), before);
    const PinnedSurface& pinned = *stage.character.state().pinned;
    std::cout << stage.border.size() << " pins, " << pinned.ring.size() << " of " << stage.asset.face().positions.size()
              << " vertices moved, " << pinned.bytes() << " bytes\n";
    EXPECT_LE(pinned.bytes(), 100 * stage.asset.face().positions.size());
}

TEST_F(Pins, TheDefaultFaceIsClosedBelowAndCutThroughTheNeckItHasABorder) {
    const Result<Face> loaded = load_face(std::string(BLUSH_BINARY_DIR) + "/assets/face.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    Face face = *loaded;
    EXPECT_TRUE(FaceAsset::create(face)->neck_border().empty()) << "eyes are open, and no neck";
    constexpr float cut = -0.12F;  // metres
    Primitive& skin = face.primitives[0];
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = skin.first_index; i < skin.first_index + skin.index_count; i += 3) {
        bool above = true;
        for (std::uint32_t c = 0; c < 3; ++c) above &= face.positions[face.indices[i + c]].y > cut;
        if (above) kept.insert(kept.end(), {face.indices[i], face.indices[i + 1], face.indices[i + 2]});
    }
    skin.first_index = static_cast<std::uint32_t>(face.indices.size());
    skin.index_count = static_cast<std::uint32_t>(kept.size());
    face.indices.insert(face.indices.end(), kept.begin(), kept.end());
    // What lies below the cut is drawn by nothing, and does not count for the height of what is.
    for (std::uint32_t v = skin.first_vertex; v < skin.first_vertex + skin.vertex_count; ++v)
        face.positions[v].y = std::max(face.positions[v].y, cut);
    const FaceAsset asset = *FaceAsset::create(face);
    const std::vector<std::uint32_t> border = asset.neck_border();
    ASSERT_GE(border.size(), 40U);
    for (const std::uint32_t b : border) EXPECT_LT(face.positions[b].y, cut + 0.01F);
    Character character = *Character::create(device_, asset);
    Scene scene = *Scene::create(device_);
    ASSERT_TRUE(scene.add(character));
    ASSERT_TRUE(character.pin(border, 30));
    std::vector<glm::vec3> positions, normals;
    for (const std::uint32_t b : border) {
        positions.push_back(face.positions[b] + glm::vec3(0.002F, 0, 0.001F));
        normals.push_back(face.normals[b]);
    }
    ASSERT_TRUE(character.move_pins(positions, normals));
    scene.deform();
    const Scene::Surface surface = test::read_published(character.surface());
    for (std::size_t i = 0; i < border.size(); ++i) EXPECT_EQ(surface.positions[border[i]], positions[i]);
    const PinnedSurface& pinned = *character.state().pinned;
    std::cout << border.size() << " pins, " << pinned.ring.size() << " of " << face.positions.size()
              << " vertices within 30 mm, " << pinned.bytes() << " bytes\n";
}

}  // namespace
}  // namespace blush
