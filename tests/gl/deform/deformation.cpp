// Stream-out against the CPU: the same bits, whatever the method, the number of targets, the pages.

#include <gtest/gtest.h>

#include <cstring>
#include <iostream>

#include "rig/deform/deform.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"
#include "tests/rotation.h"
#include "tests/ulp.h"

namespace blush {
namespace {

using test::make_face;
using test::set_weights;
using test::spread_weights;

// The shaders are `precise` and the CPU is built without fused multiply-add: the same operations in the same order. A
// device may still round its division and square root otherwise (GLSL 4.50, 4.7.1: 2.5 units in the last place), which
// only directions go through. llvmpipe: 0.
constexpr std::uint32_t position_ulp = 0;
constexpr std::uint32_t direction_ulp = 8;
// skin.vert is not `precise`: a matrix product may be fused. In units of the last place of 1 (values below are up to
// 2).
constexpr float skinning_tolerance = 4 * 1.2e-7F;

class Deformation : public test::GlTest {
protected:
    void expect_agrees_with_cpu(Face face, const std::vector<float>& weights, const char* method, const char* source) {
        Portrait character = make_character(std::move(face));
        ASSERT_TRUE(character.set("deformation.method", method));
        ASSERT_TRUE(character.set("normals.source", source));
        set_weights(character, weights);
        const Scene::Surface gpu = character.read_deformed();

        Deformer deformer(character.face());
        DeformedSurface cpu;
        const bool recomputed = std::string_view(source) == "recomputed";
        deformer.deform(weights, recomputed ? NormalMethod::recomputed : NormalMethod::authored, cpu);
        const std::uint32_t positions = test::worst_ulp<glm::vec3>(gpu.positions, cpu.positions);
        const std::uint32_t normals = test::worst_ulp<glm::vec3>(gpu.normals, cpu.normals);
        const std::uint32_t tangents = test::worst_ulp<glm::vec4>(gpu.tangents, cpu.tangents);
        worst_ = std::max({worst_, positions, normals, tangents});
        EXPECT_LE(positions, position_ulp) << method << ", " << source;
        EXPECT_LE(normals, direction_ulp) << method << ", " << source;
        EXPECT_LE(tangents, direction_ulp) << method << ", " << source;
        EXPECT_NE(cpu.positions, character.face().positions) << "the test moves nothing";
    }
    void report_worst() {
        RecordProperty("worst_ulp", std::to_string(worst_));
        std::cout << "worst difference from the CPU: " << worst_ << " ULP\n";
    }
    std::uint32_t worst_ = 0;
};

TEST_F(Deformation, EqualsTheCpuForEveryKindOfNormalAndMethod) {
    for (const bool normals : {false, true}) {
        for (const bool tangents : {false, true}) {
            const Face face = make_face({.targets = 7,
                                         .normal_deltas = normals,
                                         .odd_without_normals = tangents,
                                         .tangent_deltas = tangents,
                                         .two_primitives = normals,
                                         .seam = true});
            for (const char* method : {"sparse", "passes"}) {
                for (const char* source : {"authored", "recomputed"}) {
                    expect_agrees_with_cpu(face, spread_weights(face, 7), method, source);
                }
            }
        }
    }
    report_worst();
}

TEST_F(Deformation, EqualsTheCpuForAnyNumberOfTargets) {
    const Face face =
        make_face({.targets = 257, .normal_deltas = true, .odd_without_normals = true, .two_primitives = true});
    for (const std::size_t active : {1U, 4U, 5U, 52U, 257U}) {
        for (const char* method : {"sparse", "passes"}) {
            expect_agrees_with_cpu(face, spread_weights(face, active), method, "authored");
        }
    }
    report_worst();
}

TEST_F(Deformation, EqualsTheCpuAtExtremeWeights) {
    const Face face = make_face({.targets = 3, .normal_deltas = true});
    for (const float weight : {-1.0F, 1000.0F, 1e-20F}) {
        expect_agrees_with_cpu(face, {weight, 0.5F, 0}, "sparse", "recomputed");
    }
    report_worst();
}

struct Bits {
    std::vector<std::byte> bytes;
    bool operator==(const Bits&) const = default;
};
Bits bits_of(const Scene::Surface& surface) {
    Bits bits;
    const auto append = [&](const auto& values) {
        const auto raw = std::as_bytes(std::span(values));
        bits.bytes.insert(bits.bytes.end(), raw.begin(), raw.end());
    };
    append(surface.positions);
    append(surface.normals);
    append(surface.tangents);
    return bits;
}

TEST_F(Deformation, BothMethodsGiveTheSameBits) {
    for (const bool tangents : {false, true}) {
        const Face face =
            make_face({.targets = 60, .normal_deltas = true, .tangent_deltas = tangents, .two_primitives = true});
        Portrait character = make_character(face);
        for (const std::size_t active : {1U, 3U, 4U, 5U, 52U}) {
            set_weights(character, spread_weights(face, active, active));
            ASSERT_TRUE(character.set("deformation.method", "sparse"));
            const Bits sparse = bits_of(character.read_deformed());
            EXPECT_EQ(character.state().report->deltas_added, character.state().stream_out.last_work().deltas);
            ASSERT_TRUE(character.set("deformation.method", "passes"));
            EXPECT_EQ(bits_of(character.read_deformed()), sparse) << active << " active";
            const std::uint32_t per_pass = tangents ? 3 : 4;
            EXPECT_EQ(character.state().stream_out.last_work().passes, (active + per_pass - 1) / per_pass);
        }
    }
}

Scene::Surface read_back(const SurfaceBuffers& buffers, std::size_t count) {
    Scene::Surface surface{std::vector<glm::vec3>(count), std::vector<glm::vec3>(count), std::vector<glm::vec4>(count)};
    const auto read = [](const gl::Buffer& buffer, auto& out) {
        glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(out.size() * sizeof(out[0])), out.data());
    };
    read(buffers.positions, surface.positions);
    read(buffers.normals, surface.normals);
    read(buffers.tangents, surface.tangents);
    return surface;
}

TEST_F(Deformation, SeveralPagesOfDeltasGiveTheBitsOfOne) {
    const Face face = make_face({.targets = 9,
                                 .normal_deltas = true,
                                 .odd_without_normals = true,
                                 .tangent_deltas = true,
                                 .two_primitives = true});
    std::size_t largest = 0;
    for (const Target& target : face.targets) largest = std::max(largest, target.vertices.size());
    const auto one_page = DeformModel::create(device_, face);
    const auto many_pages = DeformModel::create(device_, face, largest * sizeof(glm::vec3));
    ASSERT_TRUE(one_page);
    ASSERT_TRUE(many_pages);
    StreamOut one(*one_page), many(*many_pages);
    const std::size_t count = face.positions.size();
    for (const std::size_t active_count : {9U, 1U, 2U, 0U, 4U}) {
        std::vector<ActiveTarget> active;
        find_active(spread_weights(face, active_count, active_count + 1), active);
        for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
            for (StreamOut* stream_out : {&one, &many}) {
                stream_out->set_active(active);
                stream_out->add_targets_sparse(method);
                stream_out->turn_normals(method);
            }
            EXPECT_EQ(bits_of(read_back(many.deformed(), count)), bits_of(read_back(one.deformed(), count)))
                << active_count << " active";
            EXPECT_EQ(many.last_work().deltas, one.last_work().deltas);
            EXPECT_EQ(one.last_work().passes, 1U);
            if (active_count == 9) {
                EXPECT_GT(many.last_work().passes, 3U);
            }
        }
    }
}

TEST_F(Deformation, ATargetBeyondOneBlockIsAnErrorThatNamesIt) {
    const Face face = make_face({.targets = 2});
    const auto made = DeformModel::create(device_, face, 10 * sizeof(glm::vec3));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().message, "test_face: target \"t0\" moves " +
                                        std::to_string(face.targets[0].vertices.size()) + " vertices; " +
                                        device_.info().renderer + " holds 10 in one block");
}

TEST_F(Deformation, ChangingWeightsAndChangingTheSetGiveWhatAFreshCharacterGives) {
    const Face face = make_face({.targets = 10, .normal_deltas = true, .odd_without_normals = true});
    Portrait kept = make_character(face);
    const std::vector<std::vector<float>> steps = {
        spread_weights(face, 4, 1), spread_weights(face, 4, 2),  // the same set, other weights
        spread_weights(face, 7, 3), spread_weights(face, 1, 4),  // other sets
        std::vector<float>(10, 0),  spread_weights(face, 10, 5),
    };
    for (std::size_t step = 0; step < steps.size(); ++step) {
        Portrait fresh = make_character(face);
        set_weights(kept, steps[step]);
        set_weights(fresh, steps[step]);
        EXPECT_EQ(bits_of(kept.read_deformed()), bits_of(fresh.read_deformed())) << "step " << step;
    }
}

TEST_F(Deformation, BackAtZeroTheRestFaceStandsBitForBit) {
    const Face face = make_face({.targets = 3, .normal_deltas = true, .tangent_deltas = true});
    const Bits rest = bits_of({face.positions, face.normals, face.tangents});
    Portrait character = make_character(face);
    for (const char* method : {"sparse", "passes"}) {
        ASSERT_TRUE(character.set("deformation.method", method));
        set_weights(character, {1, 1, 1});
        EXPECT_NE(bits_of(character.read_deformed()), rest);
        set_weights(character, {0, 0, 0});
        EXPECT_EQ(bits_of(character.read_deformed()), rest) << method;
    }
    // The stream-out itself, with nothing active.
    StreamOut& stream_out = character.state().stream_out;
    stream_out.set_active({});
    stream_out.add_targets_sparse(NormalMethod::recomputed);
    stream_out.turn_normals(NormalMethod::recomputed);
    EXPECT_EQ(bits_of(read_back(stream_out.deformed(), face.positions.size())), rest);
    stream_out.add_targets_in_passes(NormalMethod::authored);
    EXPECT_EQ(bits_of(read_back(stream_out.deformed(), face.positions.size())), rest);
}

TEST_F(Deformation, SkinningEqualsTheCpu) {
    const Face face = make_face({.targets = 2, .normal_deltas = true, .joints = true});
    Portrait character = make_character(face);
    set_weights(character, {0.7F, -0.3F});
    character.pose().nodes[1].rotation = rotation_of(glm::angleAxis(0.6F, glm::normalize(glm::vec3(1, 2, 0))));
    character.pose().nodes[2].translation.y += 0.3F;
    const Offscreen offscreen = make_offscreen(32, 32);
    test::draw(character, offscreen);

    CharacterState& state = character.state();
    DeformedSurface cpu;
    Deformer deformer(face);
    deformer.deform(std::vector<float>{0.7F, -0.3F}, NormalMethod::authored, cpu);
    const std::vector<glm::vec3> morphed = cpu.positions;
    skin(face.joints, face.joint_weights, state.stance.skinned_from_mesh, cpu.positions, cpu.normals, cpu.tangents);
    const Scene::Surface gpu = read_back(state.stream_out.skinned(), face.positions.size());
    float worst = 0, furthest = 0;
    for (std::size_t v = 0; v < face.positions.size(); ++v) {
        furthest = std::max(furthest, glm::distance(cpu.positions[v], morphed[v]));
        worst =
            std::max({worst, glm::distance(gpu.positions[v], cpu.positions[v]),
                      glm::distance(gpu.normals[v], cpu.normals[v]), glm::distance(gpu.tangents[v], cpu.tangents[v])});
    }
    std::cout << "worst difference of skinning from the CPU: " << worst << "\n";
    EXPECT_GT(furthest, 0.2F);
    EXPECT_LE(worst, skinning_tolerance);
}

}  // namespace
}  // namespace blush
