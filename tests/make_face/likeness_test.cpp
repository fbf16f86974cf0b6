/// The default face beside a measured one (ICT-FaceKit's neutral head and its expressions). No number of that head
/// enters the face; what is found here is printed and held.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <nlohmann/json.hpp>

#include "rig/names.h"
#include "runtime/files/face_file.h"
#include "runtime/files/import/file_tree.h"
#include "runtime/files/import/import_head.h"
#include "tests/gltf_builder.h"
#include "tests/make_face/likeness.h"
#include "tests/shared_data.h"
#include "tools/make_face/build_face.h"
#include "tools/make_face/expressions.h"
#include "tools/make_face/head_shape.h"

namespace blush::make_face {
namespace {

using test::LandmarkWarp;
using test::NearestSurface;
using test::Similarity;

TEST(Likeness, ASimilarityIsFoundAgain) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-50, 50);
    const double c = std::cos(0.7), s = std::sin(0.7);
    const Similarity wanted{
        glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1) * glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c), {3, -4, 5}, 1.3};
    std::vector<Vec3> from, to;
    std::vector<double> weights;
    for (int i = 0; i < 40; ++i) {
        from.emplace_back(number(random), number(random), number(random));
        to.push_back(wanted(from.back()));
        weights.push_back(1 + i % 3);
    }
    const Similarity found = test::fit_similarity(from, to, weights);
    EXPECT_NEAR(found.scale, 1.3, 1e-9);
    for (std::size_t i = 0; i < from.size(); ++i) EXPECT_LT(glm::distance(found(from[i]), to[i]), 1e-6);
}

TEST(Likeness, AWarpMeetsItsLandmarksAndKeepsAnAffineMap) {
    const std::vector<Vec3> from = {{0, 0, 0}, {9, 1, 0}, {1, 8, 2}, {3, 2, 9}, {5, 5, 5}, {-4, 3, 1}};
    std::vector<Vec3> affine, bent;
    for (const Vec3& p : from) affine.push_back(Vec3(2 * p.x + p.y, p.y - 3, p.z + 0.5 * p.x));
    bent = affine;
    bent[4] += Vec3(0, 2, 0);
    const Vec3 p(4, -3, 7);
    EXPECT_LT(glm::distance(LandmarkWarp(from, affine)(p), Vec3(2 * p.x + p.y, p.y - 3, p.z + 0.5 * p.x)), 1e-9);
    for (std::size_t i = 0; i < from.size(); ++i)
        EXPECT_LT(glm::distance(LandmarkWarp(from, bent)(from[i]), bent[i]), 1e-9);
}

TEST(Likeness, TheNearestPointIsThatOfEveryTriangle) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> number(0, 40);
    const auto point = [&] { return Vec3(number(random), number(random), number(random)); };
    std::vector<Vec3> positions;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i < 60; ++i) {
        for (int k = 0; k < 3; ++k) positions.push_back(point());
        triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    const NearestSurface all(positions, triangles);
    for (int n = 0; n < 50; ++n) {
        const Vec3 p = point();
        double best = 1e9;
        for (const glm::uvec3& t : triangles)
            best = std::min(best, NearestSurface(positions, {t}).nearest(p, Vec3(0), 100)->distance);
        EXPECT_NEAR(all.nearest(p, Vec3(0), 100)->distance, best, 1e-12);
    }
}

/// The measured head in millimetres: its skin, its targets (dense), its 68 landmarks (in the order of iBUG's 300-W).
struct Measured {
    std::vector<Vec3> positions;
    std::vector<glm::uvec3> skin;
    std::map<std::string, std::vector<Vec3>> targets;
    std::vector<Vec3> landmarks;
};

Measured measure(const std::filesystem::path& archive) {
    const Result<ImportedHead> head = import_ict(archive);
    const test::TemporaryFolder folder;
    std::ofstream(folder / "head.glb", std::ios::binary) << head->glb;
    const Result<Face> face = load_face(folder / "head.glb");
    constexpr double mm_from_cm = 10;
    Measured measured;
    for (const glm::vec3& p : face->positions) measured.positions.emplace_back(mm_from_cm * Vec3(p));
    for (const Primitive& primitive : face->primitives) {
        if (primitive.material < 0) continue;
        const std::string& material = face->materials[static_cast<std::size_t>(primitive.material)].name;
        if (material != "skin" && material != "skinBack") continue;
        for (std::uint32_t i = primitive.first_index; i < primitive.first_index + primitive.index_count; i += 3)
            measured.skin.emplace_back(face->indices[i], face->indices[i + 1], face->indices[i + 2]);
    }
    const auto add = [&](const std::string& name, const Target& target) {
        std::vector<Vec3>& deltas = measured.targets[name];
        deltas.resize(measured.positions.size(), Vec3(0));
        for (std::size_t i = 0; i < target.vertices.size(); ++i)
            deltas[target.vertices[i]] += mm_from_cm * Vec3(target.position_deltas[i]);
    };
    for (const Target& target : face->targets) {
        add(target.name, target);
        // ICT has halves of two of ARKit's shapes.
        for (const char* whole : {"browInnerUp", "cheekPuff"})
            if (target.name.starts_with(whole)) add(whole, target);
    }
    std::vector<Vec3> obj;
    std::vector<std::size_t> landmark_vertices;
    load::each_file(
        archive,
        [](std::string_view name) {
            return name.ends_with("vertex_indices.json") || name.ends_with("generic_neutral_mesh.obj");
        },
        [&](const std::string& name, const load::Bytes& bytes) {
            if (name.ends_with(".json")) {
                const auto json = nlohmann::json::parse(bytes);
                landmark_vertices = json["idx_to_landmark_verts"].get<std::vector<std::size_t>>();
                return;
            }
            std::istringstream lines(std::string(bytes.begin(), bytes.end()));
            for (std::string line; std::getline(lines, line);) {
                double x = 0, y = 0, z = 0;
                if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3)
                    obj.push_back(mm_from_cm * Vec3(x, y, z));
            }
        });
    for (const std::size_t v : landmark_vertices) measured.landmarks.push_back(obj.at(v));
    return measured;
}

struct Ours {
    Head head;
    std::vector<ShapeTarget> targets;
    std::vector<double> area;  ///< of each vertex, mm2: a third of its triangles'
};

Ours build() {
    Ours ours;
    ours.head = make_head(12'000);  // bald: hair is no part of a face's shape
    ours.targets = head_targets(ours.head);
    ours.area.assign(ours.head.mesh.positions.size(), 0);
    const auto& p = ours.head.mesh.positions;
    for (const Triangle& t : ours.head.mesh.triangles) {
        const double area = 0.5 * glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]));
        for (const Index v : t) ours.area[v] += area / 3;
    }
    return ours;
}

/// From hairline to chin, ear to ear, on our head.
bool in_face(const Ours& ours, Index v) {
    const Vec3& p = ours.head.mesh.positions[v];
    if (ours.head.tags[v].part != Part::skin) return false;
    const double azimuth = std::atan2(std::abs(p.x), p.z + 13) * 180 / pi;  // about the ears' axis
    return azimuth < 80 && p.y < 68 && p.y > -112 - 0.45 * (p.z - 85) && ours.head.mesh.normals[v].y > -0.85;
}

std::string zone(const Vec3& p) {
    const double x = std::abs(p.x);
    if (p.y > 30) return x < 30 ? "forehead" : "temple, upper";
    if (p.y > 10) return x < 48 ? "brow" : "temple";
    if (x < 16 && p.y > -16) return "root of the nose";
    if (p.y > -16 && x < 50) return "eyes";
    if (p.y > -30 && x >= 45) return "zygomatic arch";
    if (x < 20 && p.y > -50) return "nose";
    if (p.y > -50) return x < 45 ? "cheek, front" : "cheek, side";
    if (p.y > -84) return x < 28 ? "lips" : x < 45 ? "cheek, lower" : "jaw's ramus";
    return x < 22 ? "chin" : "jaw's body";
}

TEST(Likeness, TheDefaultFaceBesideTheMeasuredOne) {
    BLUSH_SHARED_OR_SKIP(archive, "faces/ict-facekit/ict_expr.tar.xz");
    const Measured measured = measure(archive);
    const Ours ours = build();
    const NearestSurface surface(measured.positions, measured.skin);
    const auto& mesh = ours.head.mesh;

    // Iterative closest points from the eyes' places.
    std::vector<Index> face;
    for (Index v = 0; v < mesh.positions.size(); ++v)
        if (in_face(ours, v)) face.push_back(v);
    Similarity align;
    const auto mean = [](const std::vector<Vec3>& all, std::size_t first, std::size_t end) {
        Vec3 sum(0);
        for (std::size_t i = first; i < end; ++i) sum += all[i];
        return sum / static_cast<double>(end - first);
    };
    align.translation = mean(measured.landmarks, 36, 48) - Vec3(0, landmark::eye_centre.y, landmark::eye_centre.z + 10);
    constexpr double reach_mm = 40;
    for (int round = 0; round < 40; ++round) {
        std::vector<Vec3> from, to;
        std::vector<double> weights;
        for (const Index v : face) {
            const auto hit = surface.nearest(align(mesh.positions[v]), align.rotation * mesh.normals[v], reach_mm);
            if (!hit) continue;
            from.push_back(mesh.positions[v]);
            to.push_back(hit->point);
            weights.push_back(ours.area[v]);
        }
        align = test::fit_similarity(from, to, weights);
    }

    struct Sum {
        double area = 0, distance = 0, outward = 0;
    };
    std::map<std::string, Sum> zones;
    std::vector<std::pair<double, double>> distances;
    Sum all;
    for (const Index v : face) {
        const Vec3 p = align(mesh.positions[v]);
        const auto hit = surface.nearest(p, align.rotation * mesh.normals[v], reach_mm);
        ASSERT_TRUE(hit);
        const double mm = hit->distance / align.scale, area = ours.area[v];
        for (Sum* sum : {&all, &zones[zone(mesh.positions[v])]}) {
            sum->area += area;
            sum->distance += area * mm;
            sum->outward += area * (glm::dot(p - hit->point, hit->normal) > 0 ? mm : -mm);
        }
        distances.emplace_back(mm, area);
    }
    std::ranges::sort(distances);
    double below = 0, worst_twentieth = 0;
    for (const auto& [mm, area] : distances) {
        below += area;
        if (below > 0.95 * all.area) {
            worst_twentieth = mm;
            break;
        }
    }
    std::printf("scale %.4f, pitch %.2f degrees; distance: mean %.2f mm, 95 %% within %.2f mm, largest %.1f mm\n",
                align.scale, std::atan2(align.rotation[1][2], align.rotation[1][1]) * 180 / pi, all.distance / all.area,
                worst_twentieth, distances.back().first);
    for (const auto& [name, sum] : zones)
        std::printf("  %-18s mean %5.2f mm, outward %+6.2f mm\n", name.c_str(), sum.distance / sum.area,
                    sum.outward / sum.area);

    // For the displacements, places answer to each other by landmarks first: a lower lip is not held to an upper one.
    const auto skin_at = [&](double x, double y) {
        Vec3 nearest(1e9);
        for (const Index v : face) {
            const Vec3& q = mesh.positions[v];
            if (glm::distance(Vec2(q), Vec2(x, y)) < glm::distance(Vec2(nearest), Vec2(x, y))) nearest = q;
        }
        return nearest;
    };
    const auto& p = mesh.positions;
    std::vector<std::pair<int, Vec3>> pairs = {{27, skin_at(0, -1)},  {30, skin_at(0, -37)},   {33, skin_at(0, -52)},
                                               {8, skin_at(0, -108)}, {57, skin_at(0, -77.5)}, {51, skin_at(0, -60)}};
    const auto both = [&](int left, int right, const Vec3& place) {
        pairs.emplace_back(left, place);
        pairs.emplace_back(right, mirrored(place));
    };
    both(54, 48, p[ours.head.upper_lip.back()]);
    both(42, 39, p[ours.head.upper_lid.front()]);
    both(45, 36, p[ours.head.upper_lid.back()]);
    both(24, 19, skin_at(34.5, 24));
    both(35, 31, skin_at(13, -45));
    std::vector<Vec3> from, to;
    for (const auto& [index, place] : pairs) {
        from.push_back(align(place));
        to.push_back(measured.landmarks.at(static_cast<std::size_t>(index)));
    }
    from.push_back(align(p[ours.head.upper_lip.front()]));  // the lips meet
    to.push_back(0.5 * (measured.landmarks.at(62) + measured.landmarks.at(66)));
    const LandmarkWarp warp(from, to);
    std::vector<std::optional<NearestSurface::Hit>> partner(p.size());
    for (Index v = 0; v < p.size(); ++v) {
        if (ours.head.tags[v].part != Part::skin) continue;
        partner[v] = surface.nearest(warp(align(p[v])), align.rotation * mesh.normals[v], reach_mm);
    }
    double sum = 0;
    int count = 0;
    std::printf("correlation of displacements, our largest move, theirs (mm)\n");
    for (const ShapeTarget& target : ours.targets) {
        const auto found = measured.targets.find(target.name);
        ASSERT_NE(found, measured.targets.end()) << target.name;
        double product = 0, own = 0, other = 0, largest = 0, their_largest = 0;
        for (Index v = 0; v < p.size(); ++v) {
            if (!partner[v]) continue;
            const glm::uvec3& t = measured.skin[partner[v]->triangle];
            Vec3 theirs(0);
            for (glm::length_t k = 0; k < 3; ++k) theirs += partner[v]->weights[k] * found->second[t[k]];
            const Vec3 mine = align.scale * (align.rotation * target.position_deltas[v]);
            product += ours.area[v] * glm::dot(mine, theirs);
            own += ours.area[v] * glm::dot(mine, mine);
            other += ours.area[v] * glm::dot(theirs, theirs);
            largest = std::max(largest, glm::length(mine));
            their_largest = std::max(their_largest, glm::length(theirs));
        }
        const double correlation = product / std::sqrt(own * other);
        std::printf("  %-20s %6.3f  %6.1f  %6.1f   rms ratio %.2f\n", target.name.c_str(), correlation, largest,
                    their_largest, std::sqrt(own / other));
        sum += correlation;
        ++count;
    }
    std::printf("mean correlation %.3f over %d targets\n", sum / count, count);

    // What the face is held to.
    EXPECT_LT(all.distance / all.area, 3);
    EXPECT_LT(worst_twentieth, 8);
    EXPECT_GT(sum / count, 0.7);
    EXPECT_EQ(count, 51);
}

}  // namespace
}  // namespace blush::make_face
