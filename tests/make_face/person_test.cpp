/// Persons: presets and parameters are read with their ranges, and the laws of the default face hold for each of them.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include <gtest/gtest.h>

#include "tools/make_face/expressions.h"
#include "tools/make_face/eyes.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/mouth_parts.h"
#include "tools/make_face/person_shape.h"

namespace blush::make_face {
namespace {

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Every preset, and each parameter alone at both ends of its range.
std::vector<Person> persons() {
    std::vector<Person> all;
    for (const auto& entry : std::filesystem::directory_iterator(BLUSH_SOURCE_DIR "/assets/presets")) {
        if (entry.path().extension() != ".json") continue;
        Result<Person> person = read_person(text_of(entry.path()), entry.path().string());
        EXPECT_TRUE(person) << (person ? "" : person.error().message);
        if (person) all.push_back(*std::move(person));
    }
    return all;
}

struct Bare {
    Head head;
    FaceParts parts;  ///< skin, an eye, the lower teeth, without materials
};

const Bare& bare() {
    static const Bare made = [] {
        Bare b;
        b.head = make_head(6'000);
        const Mesh teeth = make_teeth(Jaw::lower);
        b.parts.meshes.push_back({"skin", b.head.mesh, 0, head_targets(b.head)});
        b.parts.meshes.push_back({"eyeLeft", make_eye(), 0, {}});
        b.parts.meshes.push_back({"teethLower", teeth, 0, mandible_targets(teeth)});
        b.parts.nodes = {{"head", Vec3(0), -1},
                         {"skin", Vec3(0), 0},
                         {"eyeLeft", landmark::eye_centre, 1},
                         {"teethLower", Vec3(0), 2}};
        return b;
    }();
    return made;
}

const ShapeTarget& target(const MeshPart& part, const std::string& name) {
    for (const ShapeTarget& t : part.targets)
        if (t.name == name) return t;
    ADD_FAILURE() << "no target " << name;
    return part.targets.front();
}

TEST(Person, PresetsAreReadAndDiffer) {
    const std::vector<Person> all = persons();
    ASSERT_GE(all.size(), 3U);
    for (const Person& person : all) {
        EXPECT_EQ(person.shape.size(), parameters().size());
        for (const Person& other : all) {
            if (&person == &other) continue;
            EXPECT_NE(person.shape, other.shape);
            EXPECT_NE(person.skin.melanin, other.skin.melanin);
        }
    }
}

TEST(Person, ParametersHaveNamesRangesMeasuresAndSources) {
    for (const Parameter& p : parameters()) {
        EXPECT_LT(p.least, p.most) << p.name;
        EXPECT_TRUE(p.at_rest >= p.least && p.at_rest <= p.most) << p.name;
        EXPECT_FALSE(p.measure.empty() || p.source.empty() || p.unit.empty()) << p.name;
        EXPECT_GT(p.standard_deviation, 0) << p.name;
    }
}

TEST(Person, WrongNamesAndValuesAreOneSentence) {
    Person person;
    const auto message = [&](const char* assignment) {
        const Status status = set_parameter(person, assignment);
        return status ? std::string() : status.error().message;
    };
    EXPECT_EQ(message("jaw_width=+1"), "");
    EXPECT_EQ(person.shape[*parameter_index("jaw_width")], 1);
    EXPECT_EQ(message("jaw_with=1"), "--set: no parameter \"jaw_with\" of the face (did you mean \"jaw_width\"?)");
    EXPECT_EQ(message("jaw_width=4"), "--set: jaw_width may go from -3.0 to 3.0 (sd)");
    EXPECT_EQ(message("jaw_width=nan"), "--set jaw_width=nan: \"nan\" is not a finite number");
    EXPECT_EQ(message("jaw_width"), "--set jaw_width: not NAME=VALUE");
    const auto reading = [](const char* json) {
        const Result<Person> read = read_person(json, "a.json");
        return read ? std::string() : read.error().message;
    };
    EXPECT_EQ(reading("{}"), "a.json: top level: it is not a person: no \"blush_person\"");
    EXPECT_EQ(reading(R"({"blush_person": 1, "shape": {"age": 5}})"),
              "a.json: shape: age may go from 18.0 to 80.0 (years)");
    EXPECT_EQ(reading(R"({"blush_person": 1, "skin": {"melanin": 2}})"),
              "a.json: skin.melanin: it is not from 0 to 0.5");
    EXPECT_EQ(reading(R"({"blush_person": 1, "skin": {"colour": 2}})"),
              "a.json: skin.colour: a skin has melanin, melanin_blend, hemoglobin, hair, eyes and freckles only");
    EXPECT_EQ(reading(R"({"blush_person": 1)"), reading(R"({"blush_person": 1)"));
    EXPECT_NE(reading("{"), "");
}

/// The measures of the default head itself, taken from the implicit surface as a caliper would.
TEST(Person, TheDefaultHeadsMeasuresLieWithinTwoDeviationsOfPeoples) {
    constexpr double far = 130, step = 0.02;
    const auto outside = [&](Vec3 p, const Vec3& way) {  // where the way in from afar meets the head
        while (glm::length(p) < 2 * far && head_distance(p) > step) p += way * std::max(0.5 * head_distance(p), step);
        return p;
    };
    const auto widest = [&](double low, double high, double back, double front) {
        double x = 0;
        for (double y = low; y <= high; y += 1)
            for (double z = back; z <= front; z += 2) x = std::max(x, outside({far, y, z}, {-1, 0, 0}).x);
        return 2 * x;
    };
    const auto front = [&](double y) { return outside({0, y, far}, {0, 0, -1}); };
    Vec3 nasion(0, 0, far), gnathion(0);
    for (double y = -8; y < 14; y += 0.25)
        if (front(y).z < nasion.z) nasion = front(y);
    for (double z = 50; z < 95; z += 1) {
        const Vec3 p = outside({0, -far, z}, {0, 1, 0});
        if (p.y < gnathion.y) gnathion = p;
    }
    const auto deviations = [](const char* name, double found) {
        const Parameter& parameter = parameters()[*parameter_index(name)];
        const double off = (found - (parameter.women + parameter.men) / 2) / parameter.standard_deviation;
        std::printf("%s: %.1f mm, %+.1f deviations\n", name, found, off);
        return std::abs(off);
    };
    EXPECT_LT(deviations("head_width", widest(20, 60, -40, 30)), 2);
    EXPECT_LT(deviations("face_width", widest(-40, 0, 10, 60)), 2);
    EXPECT_LT(deviations("nose_width", widest(-46, -34, 90, 100)), 2);
    EXPECT_LT(deviations("face_height", nasion.y - gnathion.y), 2);
    EXPECT_LT(deviations("mouth_width", 2 * landmark::mouth_corner_x), 2);
    // Nasolabial angle between columella and upper lip. Uzun and Ozdemir 2014: 98.9 (10.0) and 97.9 (8.8) degrees.
    const Vec3 subnasale = front(-51.5);
    const Vec3 columella = glm::normalize(front(-41) - subnasale), lip = glm::normalize(front(-60) - subnasale);
    const double angle = std::acos(glm::dot(columella, lip)) * 180 / pi;
    std::printf("nasolabial angle: %.1f degrees\n", angle);
    EXPECT_NEAR(angle, 98.4, 2 * 9.4);
}

TEST(Person, TheDefaultIsNoMapAtAll) { EXPECT_TRUE(PersonShape(Person()).is_identity()); }

TEST(Person, AMeasureChangesByTheMillimetresThatItSays) {
    // One standard deviation more between the inner canthi, cheilia and zygia.
    const auto grown = [](const char* assignment, const Vec3& left) {
        Person person;
        EXPECT_TRUE(set_parameter(person, assignment));
        return 2 * (PersonShape(person)(left).x - left.x);
    };
    EXPECT_NEAR(grown("eye_spacing=1", {17.2, -2.6, 78}), 2.5, 0.5);
    EXPECT_NEAR(grown("mouth_width=1", {25.5, -69, 82}), 3.3, 0.8);
    EXPECT_NEAR(grown("face_width=1", {66, -28, 30}), 4.8, 1.2);
    EXPECT_NEAR(grown("jaw_width=1", {48, -72, 14}), 5.8, 1.2);
}

TEST(Person, SpaceIsNeverFoldedByAPresetOrByOneParameterAtTheEndOfItsRange) {
    std::vector<Person> all = persons();
    for (const Parameter& p : parameters()) {
        for (const double value : {p.least, p.most}) {
            Person& person = all.emplace_back();
            person.name = std::string(p.name) + "=" + std::to_string(value);
            person.shape[*parameter_index(p.name)] = value;
        }
    }
    const auto& places = bare().head.mesh.positions;
    for (const Person& person : all) {
        const PersonShape shape(person);
        for (std::size_t v = 0; v < places.size(); v += 7)
            ASSERT_GT(glm::determinant(shape.jacobian(places[v])), 0.1)
                << person.name << " at " << places[v].x << ", " << places[v].y << ", " << places[v].z;
    }
}

TEST(Person, EveryPresetKeepsTheLaws) {
    const Head& head = bare().head;
    for (const Person& person : persons()) {
        SCOPED_TRACE(person.name);
        FaceParts parts = bare().parts;
        const PersonShape shape(person);
        reshape(parts, shape);
        const MeshPart& skin = parts.meshes[0];
        const auto& p = skin.mesh.positions;

        // Halves and targets are mirror images to the bit.
        for (Index v = 0; v < p.size(); ++v) ASSERT_EQ(p[head.image[v]], mirrored(p[v]));
        for (const ShapeTarget& left : skin.targets) {
            if (!left.name.ends_with("Left")) continue;
            const ShapeTarget& right = target(skin, left.name.substr(0, left.name.size() - 4) + "Right");
            for (Index v = 0; v < p.size(); ++v)
                ASSERT_EQ(right.position_deltas[head.image[v]], mirrored(left.position_deltas[v])) << left.name;
        }
        // A blink closes the lids, and no target at any weight enters the person's own eyeball.
        const ShapeTarget& blink = target(skin, "eyeBlinkLeft");
        for (std::size_t k = 0; k < head.upper_lid.size(); ++k) {
            const Index u = head.upper_lid[k], l = head.lower_lid[k];
            EXPECT_LT(glm::distance(p[u] + blink.position_deltas[u], p[l] + blink.position_deltas[l]), 1e-6);
        }
        const Vec3 eye = parts.nodes[2].translation_mm;
        for (const ShapeTarget& t : skin.targets) {
            for (Index v = 0; v < p.size(); ++v) {
                if (t.position_deltas[v] == Vec3(0) || glm::distance(p[v], eye) > 25) continue;
                if (head.tags[v].part == Part::lid_lining && head.tags[v].depth > 0.75) continue;
                for (const double weight : {0.0, 0.5, 1.0}) {
                    const Vec3 arm = p[v] + weight * t.position_deltas[v] - eye;
                    const double distance = glm::length(arm);
                    ASSERT_GT(distance, shape.eye_scale() * eye_radius_at(std::acos(arm.z / distance)) - 0.03)
                        << t.name << " at " << weight;
                }
            }
        }
        // The jaw's opening is undone by mouthClose at the lips.
        const ShapeTarget &open = target(skin, "jawOpen"), &close = target(skin, "mouthClose");
        for (std::size_t k = 0; k < head.upper_lip.size(); ++k) {
            const Index u = head.upper_lip[k], l = head.lower_lip[k];
            EXPECT_LT(glm::distance(p[u] + open.position_deltas[u] + close.position_deltas[u],
                                    p[l] + open.position_deltas[l] + close.position_deltas[l]),
                      0.3);
        }
        // The lower teeth turn about the person's own hinge, all by one angle.
        const MeshPart& teeth = parts.meshes[2];
        const Vec3 hinge = shape(landmark::jaw_hinge);
        const ShapeTarget& opened = target(teeth, "jawOpen");
        for (std::size_t v = 0; v < teeth.mesh.positions.size(); ++v) {
            const Vec3 before = teeth.mesh.positions[v] - hinge, after = before + opened.position_deltas[v];
            EXPECT_NEAR(std::hypot(after.y, after.z), std::hypot(before.y, before.z), 1e-9);
            const double angle =
                std::atan2(before.y * after.z - before.z * after.y, before.y * after.y + before.z * after.z);
            EXPECT_NEAR(angle, jaw_open_angle, 1e-9);
        }
        // Cheeks bulge when they are raised.
        const ShapeTarget& raise = target(skin, "cheekSquintLeft");
        double outward = 0;
        for (Index v = 0; v < p.size(); ++v)
            outward = std::max(outward, glm::dot(raise.position_deltas[v], skin.mesh.normals[v]));
        EXPECT_GT(outward, 2);
    }
}

TEST(Teeth, NoTargetAndNoCommonPairPushesSkinIntoThem) {
    const Head& head = bare().head;
    const MeshPart& skin = bare().parts.meshes[0];
    const std::vector<Vec3> none(head.mesh.positions.size(), Vec3(0));
    const auto deepest = [&](const std::vector<const ShapeTarget*>& together) {
        double depth = 0;
        for (Index v = 0; v < head.mesh.positions.size(); ++v) {
            if (head.tags[v].part == Part::ear || head.tags[v].part == Part::lid_lining) continue;
            const Vec3& rest = head.mesh.positions[v];
            Vec3 end = rest;
            bool opens = false;
            for (const ShapeTarget* t : together) {
                end += t->position_deltas[v];
                opens = opens || t->name == "jawOpen";
            }
            if (depth_in_teeth(Jaw::upper, rest) == 0) depth = std::max(depth, depth_in_teeth(Jaw::upper, end));
            if (depth_in_teeth(Jaw::lower, rest) == 0)
                depth = std::max(depth, depth_in_teeth(Jaw::lower, jaw_opened(end, opens ? -1 : 0)));
        }
        return depth;
    };
    for (const ShapeTarget& t : skin.targets) {
        if (t.name == "jawForward" || t.name == "jawLeft" || t.name == "jawRight") continue;  // the teeth go along
        EXPECT_LT(deepest({&t}), 0.05) << t.name;
    }
    const auto pair = [&](const char* a, const char* b) {
        const double depth = deepest({&target(skin, a), &target(skin, b)});
        if (depth > 0.05) std::printf("  %s with %s: %.2f mm into the teeth\n", a, b, depth);
        EXPECT_LT(depth, 1.5) << a << " with " << b;
    };
    for (const char* other : {"mouthSmileLeft", "mouthFunnel", "mouthPucker", "mouthLowerDownLeft", "mouthUpperUpLeft",
                              "mouthStretchLeft", "mouthClose", "mouthFrownLeft", "mouthRollLower", "mouthRollUpper"})
        pair("jawOpen", other);
    pair("mouthSmileLeft", "mouthSmileRight");
    pair("mouthStretchLeft", "mouthStretchRight");
    pair("mouthSmileLeft", "mouthUpperUpLeft");
    pair("mouthPucker", "mouthFunnel");
}

/// z at which the line through (x, y) along the view leaves the triangle's plane, where it meets the triangle.
std::optional<double> met_at(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y) {
    const double twice = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (std::abs(twice) < 1e-12) return std::nullopt;
    const double u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / twice;
    const double v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / twice;
    if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
    return a.z + u * (b.z - a.z) + v * (c.z - a.z);
}

TEST(Mouth, ItsLiningStaysBehindTheSkinBelowTheLip) {
    const Head& head = bare().head;
    const MeshPart& skin = bare().parts.meshes[0];
    const std::vector<std::vector<const char*>> poses = {{},
                                                         {"mouthSmileLeft", "mouthSmileRight"},
                                                         {"mouthFrownLeft", "mouthFrownRight"},
                                                         {"mouthStretchLeft", "mouthStretchRight"},
                                                         {"mouthSmileLeft", "mouthSmileRight", "jawOpen"},
                                                         {"jawOpen"}};
    for (const std::vector<const char*>& pose : poses) {
        std::vector<Vec3> p = head.mesh.positions;
        for (const char* name : pose) {
            const ShapeTarget& t = target(skin, name);
            for (Index v = 0; v < p.size(); ++v) p[v] += t.position_deltas[v];
        }
        double nearest = 100;
        for (Index v = 0; v < p.size(); ++v) {
            const Vec3& at = p[v];
            // The front of the vestibule, 6 mm and more below the line of the lips.
            const Vec3& rest = head.mesh.positions[v];
            if (head.tags[v].part != Part::mouth_lining || std::abs(rest.x) > 15 || rest.z < 70 ||
                rest.y > landmark::stomion_y - 6)
                continue;
            double front = -1000;
            for (const Triangle& t : head.mesh.triangles) {
                const auto is_lining = [&](Index corner) { return head.tags[corner].part == Part::mouth_lining; };
                if (std::ranges::any_of(t, is_lining) || std::abs(p[t[0]].y - at.y) > 12) continue;
                if (const auto z = met_at(p[t[0]], p[t[1]], p[t[2]], at.x, at.y)) front = std::max(front, *z);
            }
            nearest = std::min(nearest, front - at.z);
        }
        std::printf("  %s: %.2f mm behind the skin\n", pose.empty() ? "rest" : pose.front(), nearest);
        EXPECT_GT(nearest, 0.2) << (pose.empty() ? "rest" : pose.front());
    }
}

/// The place in the default head's space that a person's place comes from: fixed-point steps, since the map is near
/// one.
Vec3 unshaped(const PersonShape& shape, const Vec3& p) {
    Vec3 q = p;
    for (int step = 0; step < 6; ++step) q += p - shape(q);
    return q;
}

TEST(Teeth, NoPresetsTargetPushesItsSkinIntoItsTeeth) {
    const Head& head = bare().head;
    for (const Person& person : persons()) {
        SCOPED_TRACE(person.name);
        FaceParts parts = bare().parts;
        const PersonShape shape(person);
        reshape(parts, shape);
        const Vec3 hinge = shape(landmark::jaw_hinge);
        const double c = std::cos(jaw_open_angle), s = -std::sin(jaw_open_angle);
        for (const ShapeTarget& t : parts.meshes[0].targets) {
            if (!t.name.starts_with("mouth") && t.name != "jawOpen" && t.name != "cheekPuff") continue;
            double deepest = 0;
            for (Index v = 0; v < head.mesh.positions.size(); ++v) {
                const VertexTag& tag = head.tags[v];
                const Vec3& rest = head.mesh.positions[v];
                if (tag.part == Part::ear || t.position_deltas[v] == Vec3(0) || std::abs(rest.x) > 36 || rest.z < 42)
                    continue;
                // Far inside, the lining is the mouth's floor and roof, which lie within the arch.
                if (tag.part == Part::mouth_lining && tag.depth > 0.5) continue;
                const Vec3 end = parts.meshes[0].mesh.positions[v] + t.position_deltas[v];
                const Vec3 arm = end - hinge;
                const Vec3 closed =
                    t.name == "jawOpen" ? hinge + Vec3(arm.x, c * arm.y - s * arm.z, s * arm.y + c * arm.z) : end;
                if (depth_in_teeth(Jaw::upper, rest) == 0)
                    deepest = std::max(deepest, depth_in_teeth(Jaw::upper, unshaped(shape, end)));
                if (depth_in_teeth(Jaw::lower, rest) == 0)
                    deepest = std::max(deepest, depth_in_teeth(Jaw::lower, unshaped(shape, closed)));
            }
            if (deepest > 0.05) std::printf("  %s, %s: %.2f mm\n", person.name.c_str(), t.name.c_str(), deepest);
            EXPECT_LT(deepest, 0.5) << t.name;
        }
    }
}

}  // namespace
}  // namespace blush::make_face
