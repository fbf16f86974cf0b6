// A part of a face deforms with the bits of the whole.

#include "rig/deform/face_part.h"

#include <gtest/gtest.h>

#include "rig/controls/head_and_eyes.h"
#include "rig/deform/deform.h"
#include "tests/rig/count_allocations.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

TEST(FacePart, HasTheBitsOfTheWhole) {
    test::Random random(5);
    for (int kind = 0; kind < 16; ++kind) {
        const Face face = test::make_face({.targets = 9,
                                           .normal_deltas = (kind & 1) != 0,
                                           .odd_without_normals = (kind & 2) != 0,
                                           .tangent_deltas = (kind & 2) != 0,
                                           .two_primitives = (kind & 4) != 0,
                                           .seam = true,
                                           .joints = (kind & 8) != 0});
        std::vector<glm::mat4> joints;
        for (std::size_t j = 0; j < (face.joints.empty() ? 0U : 2U); ++j) {
            joints.emplace_back(1);
            for (glm::length_t c = 0; c < 4; ++c) {
                for (glm::length_t r = 0; r < 3; ++r) joints[j][c][r] += random.between(-0.2F, 0.2F);
            }
        }
        const NormalTopology topology(face);
        for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
            const std::vector<float> weights = test::spread_weights(face, static_cast<std::size_t>(kind) % 10);
            DeformedSurface whole = deform_plain(face, topology, weights, method);
            if (!joints.empty()) {
                skin(face.joints, face.joint_weights, joints, whole.positions, whole.normals, whole.tangents);
            }
            for (int round = 0; round < 20; ++round) {
                // Corners of one triangle, in any order, and a vertex from anywhere.
                const auto triangle = 3 * (random.bits() % (face.indices.size() / 3));
                std::vector<std::uint32_t> vertices = {face.indices[triangle + 2], face.indices[triangle],
                                                       face.indices[triangle + 1]};
                const auto other = static_cast<std::uint32_t>(random.bits() % face.positions.size());
                if (std::ranges::find(vertices, other) == vertices.end()) vertices.push_back(other);
                FacePart part(face, vertices, FacePart::Wanted::directions);
                FacePart places(face, vertices, FacePart::Wanted::positions);
                for (int twice = 0; twice < 2; ++twice) {
                    part.deform(weights, method, joints);
                    places.deform(weights, method, joints);
                }
                for (std::size_t i = 0; i < vertices.size(); ++i) {
                    ASSERT_EQ(part.position(i), whole.positions[vertices[i]]) << kind << ": " << vertices[i];
                    ASSERT_EQ(part.normal(i), whole.normals[vertices[i]]) << kind << ": " << vertices[i];
                    ASSERT_EQ(part.tangent(i), whole.tangents[vertices[i]]) << kind << ": " << vertices[i];
                    ASSERT_EQ(places.position(i), whole.positions[vertices[i]]) << kind << ": " << vertices[i];
                }
            }
        }
    }
}

TEST(FacePart, AsksForNoMemory) {
    const Face face = test::make_face({.targets = 9});
    const std::vector<std::uint32_t> vertices = {face.indices[30], face.indices[31], face.indices[32]};
    FacePart part(face, vertices, FacePart::Wanted::directions);
    part.deform(test::spread_weights(face, 9), NormalMethod::authored, {});
    const std::vector<float> weights = test::spread_weights(face, 5);
    const std::size_t before = test::allocation_count();
    part.deform(weights, NormalMethod::authored, {});
    EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace blush
