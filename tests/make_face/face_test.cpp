/// The default face keeps its promises: exact mirror images, lids that close and stay off the eyes, lips that meet, a
/// jaw that turns about its hinge, a skin without holes, the same bytes every time.

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/names.h"
#include "tools/make_face/build_face.h"
#include "tools/make_face/coarse_head.h"
#include "tools/make_face/expressions.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/mouth_parts.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

constexpr std::size_t vertices = 12'000;

struct Built {
    Head head;
    std::vector<ShapeTarget> targets;
};

const Built& built() {
    static const Built face = [] {
        Built b;
        b.head = make_head(vertices);
        grow_hair(b.head);
        b.targets = head_targets(b.head);
        return b;
    }();
    return face;
}

const ShapeTarget& target(const std::string& name) {
    for (const ShapeTarget& t : built().targets)
        if (t.name == name) return t;
    ADD_FAILURE() << "no target " << name;
    return built().targets.front();
}

Vec3 moved(const ShapeTarget& t, Index v, double weight = 1) {
    return built().head.mesh.positions[v] + weight * t.position_deltas[v];
}

TEST(Face, HasTheSizeThatWasAskedFor) {
    for (const std::size_t asked : {std::size_t{5'000}, std::size_t{22'000}, std::size_t{100'000}}) {
        const auto count = static_cast<double>(make_head(asked).mesh.positions.size());
        EXPECT_NEAR(count, static_cast<double>(asked), 0.15 * static_cast<double>(asked));
    }
}

TEST(Face, SkinAndTongueTogetherHaveArkitsTargets) {
    std::set<std::string> names;
    for (const ShapeTarget& t : built().targets) names.insert(t.name);
    for (const ShapeTarget& t : tongue_targets(make_tongue())) names.insert(t.name);
    const std::set<std::string> wanted(arkit_names.begin(), arkit_names.end());
    EXPECT_EQ(names, wanted);
}

TEST(Face, HalvesAreMirrorImages) {
    const Head& head = built().head;
    for (Index v = 0; v < head.image.size(); ++v) {
        ASSERT_EQ(head.image[head.image[v]], v);
        ASSERT_EQ(head.mesh.positions[head.image[v]], mirrored(head.mesh.positions[v]));
    }
}

TEST(Face, LeftAndRightTargetsAreExactMirrorImages) {
    const Head& head = built().head;
    int pairs = 0, whole = 0;
    for (const ShapeTarget& left : built().targets) {
        if (left.name.ends_with("Right")) continue;
        const bool sided = left.name.ends_with("Left");
        const ShapeTarget& right = sided ? target(left.name.substr(0, left.name.size() - 4) + "Right") : left;
        (sided ? pairs : whole) += 1;
        for (Index v = 0; v < head.image.size(); ++v) {
            ASSERT_EQ(right.position_deltas[head.image[v]], mirrored(left.position_deltas[v])) << left.name;
            ASSERT_EQ(right.normal_deltas[head.image[v]], mirrored(left.normal_deltas[v])) << left.name;
        }
    }
    EXPECT_EQ(pairs * 2 + whole, 51);
}

TEST(Face, EveryTargetIsFiniteAndMovesAPartOfTheFace) {
    for (const ShapeTarget& t : built().targets) {
        std::size_t count = 0;
        for (Index v = 0; v < t.position_deltas.size(); ++v) {
            const double length = glm::length(t.position_deltas[v]);
            ASSERT_TRUE(std::isfinite(length) && std::isfinite(glm::length(t.normal_deltas[v]))) << t.name;
            ASSERT_LT(length, 45) << t.name;  // the chin's way when the jaw opens is the longest
            count += length > 0.1;
        }
        EXPECT_GE(count, 20U) << t.name;
        EXPECT_LE(count, t.position_deltas.size() * 7 / 10) << t.name;
    }
}

TEST(Face, LeftTargetsOfLidsAndBrowsLeaveTheRightEyeAlone) {
    for (const char* name : {"eyeBlinkLeft", "eyeWideLeft", "eyeSquintLeft", "browDownLeft", "browOuterUpLeft"}) {
        for (Index v = 0; v < built().head.image.size(); ++v) {
            if (built().head.mesh.positions[v].x < -15) {
                ASSERT_LT(glm::length(target(name).position_deltas[v]), 0.2) << name;
            }
        }
    }
}

TEST(Lids, ABlinkClosesTheGap) {
    const Head& head = built().head;
    const ShapeTarget& blink = target("eyeBlinkLeft");
    double widest = 0;
    for (std::size_t k = 0; k < head.upper_lid.size(); ++k) {
        EXPECT_LT(glm::distance(moved(blink, head.upper_lid[k]), moved(blink, head.lower_lid[k])), 0.3);
        widest =
            std::max(widest, glm::distance(moved(blink, head.upper_lid[k], 0), moved(blink, head.lower_lid[k], 0)));
    }
    EXPECT_GT(widest, 8) << "an eye that is open at rest";
}

TEST(Lids, NoVertexEntersAnEyeballAtAnyWeightOfAnyTarget) {
    const Head& head = built().head;
    constexpr double tolerance = 0.02;  // mm
    for (const ShapeTarget& t : built().targets) {
        for (Index v = 0; v < t.position_deltas.size(); ++v) {
            const Vec3& rest = head.mesh.positions[v];
            const Vec3 centre = rest.x < 0 ? mirrored(landmark::eye_centre) : landmark::eye_centre;
            if (glm::distance(rest, centre) > 25) continue;
            const VertexTag& tag = head.tags[v];
            if (tag.part == Part::lid_lining && tag.depth > 0.75) continue;  // sealed inside the ball on purpose
            for (const double weight : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                const Vec3 arm = moved(t, v, weight) - centre;
                const double distance = glm::length(arm);
                ASSERT_GT(distance, eye_radius_at(std::acos(arm.z / distance)) - tolerance)
                    << t.name << " at " << weight;
            }
        }
    }
}

TEST(Lips, MeetAtRestAndPartWithTheJaw) {
    const Head& head = built().head;
    const ShapeTarget& open = target("jawOpen");
    for (std::size_t k = 0; k < head.upper_lip.size(); ++k)
        EXPECT_EQ(head.mesh.positions[head.upper_lip[k]], head.mesh.positions[head.lower_lip[k]]);
    // A full opening parts the incisors by 40 to 50 mm; the shape stays a little below.
    EXPECT_GT(glm::distance(moved(open, head.upper_lip[0]), moved(open, head.lower_lip[0])), 30);
}

Index skin_nearest(const Vec3& place) {
    const Head& head = built().head;
    Index best = 0;
    for (Index v = 0; v < head.mesh.positions.size(); ++v) {
        if (head.tags[v].part != Part::skin) continue;
        if (glm::distance(head.mesh.positions[v], place) < glm::distance(head.mesh.positions[best], place)) best = v;
    }
    return best;
}

TEST(Smile, DrawsTheCornersUpOutAndBackAndBendsTheLipsAsABow) {
    const Head& head = built().head;
    const ShapeTarget& smile = target("mouthSmileLeft");
    const Vec3 corner = smile.position_deltas[head.upper_lip.back()];
    EXPECT_GT(corner.x, 6);
    EXPECT_GT(corner.y, 6);
    EXPECT_LT(corner.z, -3);
    // A V would lift the lip's quarter by half of the corner's way.
    const Vec3 inner = smile.position_deltas[head.upper_lip[head.upper_lip.size() / 3]];
    EXPECT_LT(inner.y, 0.35 * corner.y);
}

TEST(Smile, LiftsTheCheekOverANasolabialFold) {
    const ShapeTarget& smile = target("mouthSmileLeft");
    const auto outward = [&](const Vec3& place) {
        const Index v = skin_nearest(place);
        return glm::dot(smile.position_deltas[v], built().head.mesh.normals[v]);
    };
    EXPECT_GT(smile.position_deltas[skin_nearest({36, -38, 70})].y, 4);
    const double cheek = outward({36, -48, 72}), crease = outward({25, -56, 84});
    EXPECT_GT(cheek, crease + 3) << "millimetres along the skin's normal";
}

TEST(Lips, MouthCloseSealsAnOpenJaw) {
    const Head& head = built().head;
    const ShapeTarget &open = target("jawOpen"), &close = target("mouthClose");
    for (std::size_t k = 0; k < head.upper_lip.size(); ++k) {
        const Index u = head.upper_lip[k], l = head.lower_lip[k];
        EXPECT_LT(glm::distance(moved(open, u) + close.position_deltas[u], moved(open, l) + close.position_deltas[l]),
                  0.3)
            << k;
    }
}

TEST(Jaw, TurnsAboutItsHinge) {
    const Mesh teeth = make_teeth(Jaw::lower);
    for (const ShapeTarget& t : mandible_targets(teeth)) {
        if (t.name != "jawOpen") continue;
        for (std::size_t v = 0; v < teeth.positions.size(); ++v) {
            const Vec3 before = teeth.positions[v] - landmark::jaw_hinge, after = before + t.position_deltas[v];
            EXPECT_NEAR(std::hypot(after.y, after.z), std::hypot(before.y, before.z), 1e-9);
            EXPECT_EQ(after.x, before.x);
        }
    }
    const Index chin = built().head.lower_lip[0];
    EXPECT_LT(target("jawOpen").position_deltas[chin].y, -20);
}

TEST(Skin, HasNoHoleButBehindTheLidsAndInTheThroat) {
    const Head& head = built().head;
    // The bust's sharp edge is two rows of vertices in the same places.
    std::map<std::array<double, 3>, Index> rim;
    const auto place = [&](Index v) {
        const Vec3& p = head.mesh.positions[v];
        return p.y < -200 ? rim.try_emplace({p.x, p.y, p.z}, head.weld[v]).first->second : head.weld[v];
    };
    std::map<std::pair<Index, Index>, int> edges;
    for (const Triangle& t : head.mesh.triangles)
        for (std::size_t c = 0; c < 3; ++c) ++edges[std::minmax(place(t[c]), place(t[(c + 1) % 3]))];
    for (const auto& [edge, count] : edges) {
        if (count == 2) continue;
        ASSERT_EQ(count, 1);
        for (const Index v : {edge.first, edge.second}) {
            const VertexTag& tag = head.tags[v];
            const bool hidden = tag.depth == 1 || tag.part == Part::ear;  // the ear's root is sunk into the head
            const bool throat = tag.part == Part::mouth_lining && tag.depth == 1;
            ASSERT_TRUE(hidden || throat) << "a hole at " << head.mesh.positions[v].x << ", "
                                          << head.mesh.positions[v].y << ", " << head.mesh.positions[v].z;
        }
    }
}

TEST(Skin, NormalsAreUnitAndTextureCoordinatesInside) {
    const Mesh& mesh = built().head.mesh;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ASSERT_NEAR(glm::length(mesh.normals[v]), 1, 1e-9);
        ASSERT_TRUE(mesh.uv[v].x >= 0 && mesh.uv[v].x <= 1 && mesh.uv[v].y >= 0 && mesh.uv[v].y <= 1);
    }
}

/// What the texture gives the skin: texels a millimetre on a side of 2,048 by quantile of area, and texels of 1,000
/// that two triangles cover.
struct Layout {
    double low = 0, median = 0, high = 0;  ///< 5 %, 50 %, 95 %
    int overlapping = 0, covered = 0;
};
Layout measure_layout(const Head& head) {
    constexpr int side = 1'000;
    std::vector<std::uint8_t> cover(static_cast<std::size_t>(side) * side, 0);
    std::vector<std::pair<double, double>> density;
    double whole = 0;
    for (const Triangle& t : head.mesh.triangles) {
        const auto& p = head.mesh.positions;
        const Vec2 a = head.mesh.uv[t[0]], b = head.mesh.uv[t[1]], c = head.mesh.uv[t[2]];
        const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        const double area = glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
        const bool skin = std::ranges::all_of(t, [&](Index v) { return head.tags[v].part == Part::skin; });
        if (skin && area > 1e-6) {
            density.emplace_back(2'048 * std::sqrt(std::abs(twice) / area), area);
            whole += area;
        }
        if (twice == 0) continue;
        const Vec2 low = glm::min(a, glm::min(b, c)) * static_cast<double>(side),
                   high = glm::max(a, glm::max(b, c)) * static_cast<double>(side);
        for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y) {
            for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
                const Vec2 q((x + 0.5) / side, (y + 0.5) / side);
                const double wa = ((b.x - q.x) * (c.y - q.y) - (c.x - q.x) * (b.y - q.y)) / twice;
                const double wb = ((c.x - q.x) * (a.y - q.y) - (a.x - q.x) * (c.y - q.y)) / twice;
                if (wa > 1e-9 && wb > 1e-9 && wa + wb < 1 - 1e-9)
                    ++cover[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
            }
        }
    }
    std::ranges::sort(density);
    Layout layout;
    double below = 0;
    for (const auto& [texels, area] : density) {
        below += area;
        if (below < 0.05 * whole) layout.low = texels;
        if (below < 0.5 * whole) layout.median = texels;
        if (below < 0.95 * whole) layout.high = texels;
    }
    for (const std::uint8_t count : cover) {
        layout.covered += count > 0;
        layout.overlapping += count > 1;
    }
    return layout;
}

/// At every size: mirror images, closed lips, a parted eye, no triangle without area, no overlap in the texture.
TEST(Sizes, KeepSeamsSlitsAndTexture) {
    for (const std::size_t asked : {least_vertices, std::size_t{100'000}}) {
        SCOPED_TRACE(asked);
        const Head head = make_head(asked);
        const auto& p = head.mesh.positions;
        for (Index v = 0; v < head.image.size(); ++v) ASSERT_EQ(p[head.image[v]], mirrored(p[v]));
        for (Index v = 0; v < head.weld.size(); ++v) ASSERT_EQ(p[head.weld[v]], p[v]);
        for (std::size_t k = 0; k < head.upper_lip.size(); ++k) ASSERT_EQ(p[head.upper_lip[k]], p[head.lower_lip[k]]);
        double widest = 0;
        for (std::size_t k = 0; k < head.upper_lid.size(); ++k)
            widest = std::max(widest, glm::distance(p[head.upper_lid[k]], p[head.lower_lid[k]]));
        EXPECT_GT(widest, 8);
        // The skin lies on the head's surface, whatever its tessellation: nostrils and the bust's cut apart.
        double sum = 0, count = 0;
        for (Index v = 0; v < p.size(); ++v) {
            if (head.tags[v].part != Part::skin || p[v].y < -130) continue;
            if (std::abs(p[v].x) < 30 && p[v].y < -40 && p[v].y > -80 && p[v].z > 70) continue;
            sum += std::abs(head_distance(p[v]));
            ++count;
        }
        EXPECT_LT(sum / count, 0.05) << "millimetres";
        const Layout layout = measure_layout(head);
        EXPECT_LE(layout.overlapping, layout.covered / 5'000);
        EXPECT_LT(layout.high / layout.low, 2);
    }
}

TEST(Sizes, TheSmallestKeepsTheLawsOfLidsAndLips) {
    const Head head = make_head(least_vertices);
    const std::vector<ShapeTarget> targets = head_targets(head);
    const auto named = [&](const std::string& name) -> const ShapeTarget& {
        return *std::ranges::find(targets, name, &ShapeTarget::name);
    };
    const auto& p = head.mesh.positions;
    const auto &blink = named("eyeBlinkLeft").position_deltas, &open = named("jawOpen").position_deltas,
               &close = named("mouthClose").position_deltas;
    for (std::size_t k = 0; k < head.upper_lid.size(); ++k) {
        const Index u = head.upper_lid[k], l = head.lower_lid[k];
        EXPECT_EQ(p[u] + blink[u], p[l] + blink[l]);
    }
    for (std::size_t k = 0; k < head.upper_lip.size(); ++k) {
        const Index u = head.upper_lip[k], l = head.lower_lip[k];
        EXPECT_LT(glm::distance(open[u] + close[u], open[l] + close[l]), 0.3);
    }
}

TEST(Texture, HasEvenDensityAndNoOverlaps) {
    const Layout layout = measure_layout(built().head);
    std::printf(
        "texels a mm at 2,048: 5 %% %.2f, median %.2f, 95 %% %.2f (ratio %.2f); %.1f %% used, %d of %d overlap\n",
        layout.low, layout.median, layout.high, layout.high / layout.low, layout.covered / 1e4, layout.overlapping,
        layout.covered);
    EXPECT_LT(layout.high / layout.low, 2);
    EXPECT_LE(layout.overlapping, layout.covered / 5'000);  // folds of less than a texel under the nose's tip
    EXPECT_GT(layout.covered, 500'000);
}

TEST(File, SameRequestSameBytesFromOneThreadAndFromTwo) {
    most_threads = 1;
    const std::string once = glb_bytes(build_face(5'000, {}, 128));
    EXPECT_GT(once.size(), 1'000'000U);
    EXPECT_EQ(once.substr(0, 4), "glTF");
    most_threads = 2;
    EXPECT_TRUE(once == glb_bytes(build_face(5'000, {}, 128)));
    most_threads = 16;
}

TEST(Face, TheRelaxedGridDoesNotDependOnThreads) {
    most_threads = 1;
    const CoarseHead alone;
    most_threads = 3;
    const CoarseHead shared;
    most_threads = 16;
    for (double row = 0; row <= alone.grid().last_row(); row += 2.5) {
        for (double column = 0; column <= alone.grid().last_column(); column += 3.5) {
            ASSERT_EQ(alone.at(column, row, true).position, shared.at(column, row, true).position);
            ASSERT_EQ(alone.at(column, row, true).flat, shared.at(column, row, true).flat);
        }
    }
}

TEST(File, BadPathIsOneSentenceAndLeavesNothing) {
    const Status status = write_file("no_such_folder/face.glb", "x");
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().message, "no_such_folder/face.glb: cannot be written: No such file or directory");
    const Status folder = write_file(".", "x");
    ASSERT_FALSE(folder);
    EXPECT_EQ(folder.error().message, ".: cannot be written: it is a folder");
    EXPECT_FALSE(std::filesystem::exists("no_such_folder"));
}

}  // namespace
}  // namespace blush::make_face
