// The CPU's vertex path against the plain definition: the same bits on every instruction set, for every split into
// ranges, for every batch of faces.

#include "rig/deform/vertex_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "rig/deform/deform.h"
#include "tests/rig/count_allocations.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

using test::make_face;
using test::Random;
using test::spread_weights;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float denormal = std::numeric_limits<float>::denorm_min();
constexpr float largest = std::numeric_limits<float>::max();

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// An output that shows what was not written.
DeformedSurface unwritten(const Face& face) {
    const std::size_t count = face.positions.size();
    return {std::vector<glm::vec3>(count, glm::vec3(nan)), std::vector<glm::vec3>(count, glm::vec3(nan)),
            std::vector<glm::vec4>(count, glm::vec4(nan))};
}

VertexPath::Job job_of(const ActivePieces& active, NormalMethod method, DeformedSurface& out) {
    return {&active, method, out.positions, out.normals, out.tangents};
}

DeformedSurface deformed(const VertexPath& path, const Face& face, std::span<const float> weights,
                         NormalMethod method) {
    ActivePieces active;
    active.build(path.targets(), weights);
    DeformedSurface out = unwritten(face);
    const VertexPath::Job job = job_of(active, method, out);
    path.add_targets({&job, 1}, path.all_vertices());
    path.turn_normals({&job, 1}, path.all_vertices());
    return out;
}

void expect_same(const DeformedSurface& found, const DeformedSurface& expected, const std::string& what) {
    EXPECT_TRUE(same_bits(found.positions, expected.positions)) << "positions, " << what;
    EXPECT_TRUE(same_bits(found.normals, expected.normals)) << "normals, " << what;
    EXPECT_TRUE(same_bits(found.tangents, expected.tangents)) << "tangents, " << what;
}

/// Every instruction set of this machine, both methods, against deform_plain().
void expect_plain_bits(const Face& face, std::span<const float> weights, const std::string& what) {
    const NormalTopology topology(face);
    for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
        const DeformedSurface expected = deform_plain(face, topology, weights, method);
        for (const SimdPath simd : simd_paths()) {
            const VertexPath path(face, {}, simd);
            expect_same(deformed(path, face, weights, method), expected, what + ", " + std::string(name_of(simd)));
        }
    }
}

/// Targets as the vertex path minds them: rows of every length and alignment, single vertices, deltas of zero, and in
/// the rest attributes zeros of either sign.
Face awkward_face(std::uint32_t side, std::uint64_t seed) {
    Face face = make_face({.side = side, .targets = 0, .two_primitives = true, .seed = seed});
    Random random(seed);
    const auto count = static_cast<std::uint32_t>(face.positions.size());
    const auto chance = [&](std::uint64_t of) { return random.bits() % of == 0; };
    const auto some_zeros = [&](auto& vectors) {
        for (auto& vector : vectors) {
            for (glm::length_t c = 0; c < 3; ++c) {
                if (chance(6)) vector[c] = chance(2) ? 0.0F : -0.0F;
            }
        }
    };
    some_zeros(face.positions);
    some_zeros(face.normals);
    some_zeros(face.tangents);
    for (std::uint32_t t = 0; t < 9; ++t) {
        Target target;
        target.name = "t" + std::to_string(t);
        std::uint32_t v = static_cast<std::uint32_t>(random.bits() % 7);
        while (v < count) {
            for (std::uint64_t left = 1 + random.bits() % (t < 3 ? 2 : 40); left > 0 && v < count; --left, ++v) {
                const auto delta = [&](float size) {
                    glm::vec3 value(random.between(-size, size), random.between(-size, size),
                                    random.between(-size, size));
                    for (glm::length_t c = 0; c < 3; ++c) {
                        if (chance(4)) value[c] = chance(2) ? 0.0F : -0.0F;
                    }
                    return chance(5) ? glm::vec3(0) : value;
                };
                target.vertices.push_back(v);
                target.position_deltas.push_back(delta(0.1F));
                if (t % 3 != 1) target.normal_deltas.push_back(delta(0.5F));
                if (t % 3 == 2) target.tangent_deltas.push_back(delta(0.5F));
            }
            v += 1 + static_cast<std::uint32_t>(random.bits() % (t % 2 == 0 ? 4 : 90));
        }
        face.targets.push_back(std::move(target));
    }
    // The first primitive's normals are the targets' own, the second's turn with the surface.
    face.primitives[0].normal_source = NormalSource::authored;
    face.primitives[1].normal_source = NormalSource::recomputed;
    return face;
}

TEST(VertexPath, GivesThePlainBitsOnEveryInstructionSet) {
    for (const std::uint32_t side : {2U, 3U, 5U, 13U, 64U, 71U}) {  // 4 to 5,041 vertices, full tiles and others
        const Face face = awkward_face(side, side);
        for (const std::size_t active : {1U, 4U, 9U}) {
            expect_plain_bits(face, spread_weights(face, active, side + active),
                              std::to_string(side) + " a side, " + std::to_string(active) + " active");
        }
    }
}

TEST(VertexPath, GivesThePlainBitsOnUsualFaces) {
    for (const bool normals : {false, true}) {
        for (const bool tangents : {false, true}) {
            const Face face = make_face({.side = 40,
                                         .targets = 12,
                                         .normal_deltas = normals,
                                         .odd_without_normals = tangents,
                                         .tangent_deltas = tangents,
                                         .two_primitives = normals,
                                         .seam = true});
            expect_plain_bits(face, spread_weights(face, 12), normals ? "normals" : "no normals");
        }
    }
}

TEST(VertexPath, GivesThePlainBitsAtEveryKindOfWeight) {
    const Face face = awkward_face(33, 5);
    Random random(11);
    for (const float weight : {nan, infinity, -infinity, largest, -largest, 1e30F, denormal, -denormal, -0.0F, -1.0F}) {
        std::vector<float> weights(face.targets.size(), weight);
        expect_plain_bits(face, weights, "all " + std::to_string(weight));
        for (float& other : weights) {
            if (random.bits() % 2 == 0) other = random.between(-1, 1);
        }
        expect_plain_bits(face, weights, "some " + std::to_string(weight));
    }
}

TEST(VertexPath, AtRestGivesTheRestBits) {
    const Face face = awkward_face(33, 2);
    const VertexPath path(face);
    const std::vector<float> weights(face.targets.size(), 0);
    for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
        expect_same(deformed(path, face, weights, method), {face.positions, face.normals, face.tangents}, "at rest");
    }
}

TEST(VertexPath, ASingleTargetAtOneGivesRestPlusItsDeltas) {
    const Face face = awkward_face(33, 3);
    const VertexPath path(face);
    std::vector<float> weights(face.targets.size(), 0);
    weights[4] = 1;
    std::vector<glm::vec3> expected = face.positions;
    const Target& target = face.targets[4];
    for (std::size_t i = 0; i < target.vertices.size(); ++i) expected[target.vertices[i]] += target.position_deltas[i];
    EXPECT_TRUE(same_bits(deformed(path, face, weights, NormalMethod::authored).positions, expected));
}

/// Cuts [0, count) at random places, and shuffles the parts.
std::vector<VertexRange> random_split(std::uint32_t count, Random& random) {
    std::vector<std::uint32_t> cuts = {0, count};
    for (std::uint64_t k = random.bits() % 40; k > 0; --k) {
        cuts.push_back(static_cast<std::uint32_t>(random.bits() % (count + 1)));
    }
    std::ranges::sort(cuts);
    std::vector<VertexRange> ranges;
    for (std::size_t i = 1; i < cuts.size(); ++i) ranges.push_back({cuts[i - 1], cuts[i]});
    for (std::size_t i = ranges.size(); i > 1; --i) std::swap(ranges[i - 1], ranges[random.bits() % i]);
    return ranges;
}

TEST(VertexPath, AnySplitIntoRangesGivesTheSameBits) {
    const Face face = awkward_face(53, 8);
    const std::vector<float> weights = spread_weights(face, 9);
    Random random(4);
    for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
        const DeformedSurface expected = deform_plain(face, NormalTopology(face), weights, method);
        for (const SimdPath simd : simd_paths()) {
            const VertexPath path(face, {}, simd);
            ActivePieces active;
            active.build(path.targets(), weights);
            for (int trial = 0; trial < 12; ++trial) {
                DeformedSurface out = unwritten(face);
                const VertexPath::Job job = job_of(active, method, out);
                for (const VertexRange range : random_split(path.targets().vertex_count, random)) {
                    path.add_targets({&job, 1}, range);
                }
                for (const VertexRange range : random_split(path.targets().vertex_count, random)) {
                    path.turn_normals({&job, 1}, range);
                }
                expect_same(out, expected, std::string(name_of(simd)));
            }
        }
    }
}

TEST(VertexPath, ARangeLeavesTheRestOfTheOutputAlone) {
    const Face face = make_face({.side = 53, .targets = 9, .normal_deltas = true, .tangent_deltas = true});
    const std::vector<float> weights = spread_weights(face, 9);
    for (const SimdPath simd : simd_paths()) {
        const VertexPath path(face, {}, simd);
        ActivePieces active;
        active.build(path.targets(), weights);
        const VertexRange range{1021, 2051};
        DeformedSurface out = unwritten(face);
        const VertexPath::Job job = job_of(active, NormalMethod::authored, out);
        path.add_targets({&job, 1}, range);
        for (std::uint32_t v = 0; v < path.targets().vertex_count; ++v) {
            const bool written = v >= range.first && v < range.last;
            ASSERT_EQ(std::isnan(out.positions[v].x), !written) << v;
            ASSERT_EQ(std::isnan(out.normals[v].x), !written) << v;
            ASSERT_EQ(std::isnan(out.tangents[v].w), !written) << v;
        }
        path.add_targets({&job, 1}, {70, 70});  // nothing
        path.add_targets({}, path.all_vertices());
        EXPECT_TRUE(std::isnan(out.positions[70].x));
    }
}

TEST(VertexPath, PositionsAloneAreThoseOfTheWholeSurface) {
    const Face face = awkward_face(53, 8);
    const std::vector<float> weights = spread_weights(face, 9);
    const VertexPath path(face);
    ActivePieces active;
    active.build(path.targets(), weights);
    std::vector<glm::vec3> positions(face.positions.size());
    const VertexPath::Job job{&active, NormalMethod::authored, positions, {}, {}};
    path.add_targets({&job, 1}, path.all_vertices());
    path.turn_normals({&job, 1}, path.all_vertices());
    EXPECT_TRUE(same_bits(positions, deformed(path, face, weights, NormalMethod::authored).positions));
}

TEST(VertexPath, AnyBatchOfFacesGivesEachItsOwnBits) {
    const Face face = awkward_face(40, 6);
    const NormalTopology topology(face);
    constexpr std::size_t crowd = 23;
    Random random(9);
    std::vector<std::vector<float>> weights;
    for (std::size_t f = 0; f < crowd; ++f) weights.push_back(spread_weights(face, random.bits() % 10, f));
    for (const SimdPath simd : simd_paths()) {
        const VertexPath path(face, {}, simd);
        std::vector<ActivePieces> active(crowd);
        std::vector<DeformedSurface> out(crowd, unwritten(face));
        std::vector<VertexPath::Job> jobs;
        for (std::size_t f = 0; f < crowd; ++f) {
            active[f].build(path.targets(), weights[f]);
            jobs.push_back(job_of(active[f], f % 2 == 0 ? NormalMethod::authored : NormalMethod::recomputed, out[f]));
        }
        for (std::size_t first = 0; first < crowd;) {
            const std::size_t batch = std::min<std::size_t>(1 + random.bits() % 9, crowd - first);
            const auto part = std::span(jobs).subspan(first, batch);
            path.add_targets(part, path.all_vertices());
            path.turn_normals(part, path.all_vertices());
            first += batch;
        }
        for (std::size_t f = 0; f < crowd; ++f) {
            expect_same(out[f], deform_plain(face, topology, weights[f], jobs[f].method), "face " + std::to_string(f));
        }
    }
}

TEST(VertexPath, TakesFacesWithoutTargetsAndTargetsThatTouchNothing) {
    Face none = make_face({.targets = 0});
    expect_plain_bits(none, {}, "no target");
    Face empty = make_face({.targets = 2, .normal_deltas = true});
    empty.targets.insert(empty.targets.begin() + 1, Target{});
    expect_plain_bits(empty, std::vector<float>{1, 1, 1}, "an empty target among others");
    expect_plain_bits(empty, std::vector<float>{0, 1, 0}, "an empty target alone");
    Face unused = make_face({.side = 2, .targets = 1});
    unused.primitives.clear();  // no primitive says whose normals these are
    unused.indices.clear();
    unused.meshes[0].primitive_count = 0;
    expect_plain_bits(unused, std::vector<float>{1}, "no primitive");
}

TEST(VertexPath, AddsInAscendingOrderOfTarget) {
    // (1e8 + 1) - 1e8 is 0 in single precision and (1e8 - 1e8) + 1 is 1: the order shows.
    Face face = make_face({.side = 8, .targets = 0});
    for (const float step : {1e8F, 1.0F, -1e8F}) {
        Target target;
        for (std::uint32_t v = 0; v < face.positions.size(); ++v) {
            target.vertices.push_back(v);
            target.position_deltas.emplace_back(step);
        }
        face.targets.push_back(target);
    }
    const std::vector<float> weights = {1, 1, 1};
    const DeformedSurface surface = deformed(VertexPath(face), face, weights, NormalMethod::authored);
    for (const glm::vec3 position : surface.positions) EXPECT_EQ(position, glm::vec3(0));
    expect_plain_bits(face, weights, "an order that shows");
}

TEST(VertexPath, DoesNotFuseMultiplyAndAdd) {
    // w * d = 1 + 2^-11 + 2^-24 rounds to 1 + 2^-11; a fused sum with -(1 + 2^-11) would keep the 2^-24.
    Face face = make_face({.side = 8, .targets = 0});
    const float factor = 1 + std::ldexp(1.0F, -12);
    for (glm::vec3& position : face.positions) position = glm::vec3(-factor * factor);
    Target target;
    for (std::uint32_t v = 0; v < face.positions.size(); ++v) {
        target.vertices.push_back(v);
        target.position_deltas.emplace_back(factor);
    }
    face.targets = {target};
    for (const SimdPath simd : simd_paths()) {
        const VertexPath path(face, {}, simd);
        for (const glm::vec3 p : deformed(path, face, std::vector<float>{factor}, NormalMethod::authored).positions) {
            ASSERT_EQ(p, glm::vec3(0)) << name_of(simd);
        }
    }
}

TEST(VertexPath, DoesNotAllocateAfterFirstUse) {
    const Face face = awkward_face(40, 1);
    Deformer deformer(face);
    DeformedSurface surface;
    deformer.deform(std::vector<float>(face.targets.size(), 0.5F), NormalMethod::authored, surface);
    std::vector<float> weights = spread_weights(face, 5);
    const std::size_t before = test::allocation_count();
    for (const NormalMethod method : {NormalMethod::authored, NormalMethod::recomputed}) {
        for (float& weight : weights) weight *= 0.9F;
        deformer.deform(weights, method, surface);
    }
    EXPECT_EQ(test::allocation_count(), before);
}

// --- compact deltas: what they cost is bounded ----------------------------------------------------------------------

double worst_move(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    double worst = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
        worst = std::max(worst, glm::distance(glm::dvec3(a[v]), glm::dvec3(b[v])));
    return worst;
}

TEST(PackedTargets, SixteenBitsStayWithinHalfAStepAndGiveOneAnswer) {
    const Face face = awkward_face(53, 21);
    const std::vector<float> weights = spread_weights(face, 9);
    const DeformedSurface exact = deformed(VertexPath(face), face, weights, NormalMethod::authored);
    double bound = 0;
    for (std::size_t t = 0; t < weights.size(); ++t) {
        float most = 0;
        for (const glm::vec3 d : face.targets[t].position_deltas) {
            most = std::max({most, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        }
        // Half a step in each of three components, and a share for the rounding of the sum itself.
        bound += std::sqrt(3.0) * 0.501 * static_cast<double>(most) / 32767 * std::abs(static_cast<double>(weights[t]));
    }
    bound += 9 * 1.2e-7;
    std::vector<glm::vec3> first;
    for (const SimdPath simd : simd_paths()) {
        const VertexPath path(face, {.precision = DeltaPrecision::sixteen_bits}, simd);
        EXPECT_LT(path.targets().bytes(), VertexPath(face).targets().bytes() * 7 / 10);
        const DeformedSurface compact = deformed(path, face, weights, NormalMethod::authored);
        const double worst = worst_move(compact.positions, exact.positions);
        EXPECT_GT(worst, 0);
        EXPECT_LE(worst, bound);
        if (first.empty()) first = compact.positions;
        EXPECT_TRUE(same_bits(compact.positions, first)) << name_of(simd);
    }
}

TEST(PackedTargets, SixteenBitsTakeDeltasOfAnySize) {
    Face face = make_face({.side = 8, .targets = 0});
    for (const float size : {denormal, 3e-39F, 1e-30F, 1e30F}) {
        Target target;
        for (std::uint32_t v = 0; v < face.positions.size(); v += 3) {
            target.vertices.push_back(v);
            target.position_deltas.emplace_back(size, -size, 0.25F * size);
        }
        face.targets.push_back(target);
    }
    const VertexPath path(face, {.precision = DeltaPrecision::sixteen_bits});
    for (std::size_t t = 0; t < face.targets.size(); ++t) {
        std::vector<float> weights(face.targets.size(), 0);
        weights[t] = 1;
        const DeformedSurface out = deformed(path, face, weights, NormalMethod::recomputed);
        for (std::size_t v = 0; v < out.positions.size(); ++v) {
            ASSERT_TRUE(std::isfinite(out.positions[v].x + out.positions[v].y + out.positions[v].z));
            if (t == 3 && v % 3 == 0) {
                ASSERT_NEAR(out.positions[v].x, 1e30F, 1e26F);
            }
        }
    }
}

TEST(PackedTargets, DroppingSmallDeltasStaysWithinItsBound) {
    const Face face = make_face({.side = 40, .targets = 8, .normal_deltas = true});
    const std::vector<float> weights = spread_weights(face, 8);
    double weight_sum = 0;
    for (const float weight : weights) weight_sum += std::abs(static_cast<double>(weight));
    const DeformedSurface exact = deformed(VertexPath(face), face, weights, NormalMethod::authored);
    std::size_t dropped = 0;
    for (const float threshold : {0.001F, 0.01F}) {
        const VertexPath path(face, {.drop_below = threshold});
        EXPECT_GT(path.targets().dropped, dropped);
        dropped = path.targets().dropped;
        const DeformedSurface fewer = deformed(path, face, weights, NormalMethod::authored);
        const double worst = worst_move(fewer.positions, exact.positions);
        EXPECT_GT(worst, 0);
        EXPECT_LE(worst, static_cast<double>(threshold) * weight_sum + 8 * 1.2e-7);
        EXPECT_TRUE(same_bits(fewer.normals, exact.normals));  // NORMAL deltas stay
    }
    EXPECT_EQ(VertexPath(face).targets().dropped, 0U);
}

}  // namespace
}  // namespace blush
