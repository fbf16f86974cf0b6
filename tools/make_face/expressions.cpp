#include "tools/make_face/expressions.h"

#include <functional>

#include "tools/make_face/head_shape.h"
#include "tools/make_face/lids.h"
#include "tools/make_face/mouth_parts.h"

namespace blush::make_face {
namespace {

using namespace landmark;

/// A muscle's pull: a soft region of skin that moves as one, strongest at its centre.
struct Pull {
    Vec3 centre, widths, move;
    enum Lips { both, upper, lower } lips = both;
};
using Pulls = std::vector<Pull>;

constexpr Vec3 mouth_corner{25.5, -69, 82};

Pulls operator*(Pulls pulls, double strength) {
    for (Pull& pull : pulls) pull.move *= strength;
    return pulls;
}
Pulls both_sides(const Pulls& left) {
    Pulls all = left;
    for (const Pull& pull : left) all.push_back({mirrored(pull.centre), pull.widths, mirrored(pull.move), pull.lips});
    return all;
}

/// 1 on what belongs to the upper lip and above, 0 below; a step at the slit, a soft slope beside the mouth's corner.
double upper_share(const Vec3& p, int lip, double softness) {
    const double slope = smooth_step(-softness, softness, p.y - lip_line_y(p.x));
    const double local = 1 - std::pow(std::min(1.0, std::abs(p.x) / mouth_corner_x), 3);
    const double near_lips = local * smooth_step(50, 70, p.z);
    return mix(slope, lip > 0 ? 1 : lip < 0 ? 0 : 0.5, near_lips);
}

/// The mandible's hold on the skin: 1 on the chin and the lower lip, 0 on the upper face, the nape and the neck's end.
double jaw_share(const Vec3& p, int lip) {
    const Vec3 corner(0, stomion_y, 82);
    const Vec3 line = glm::normalize(corner - jaw_hinge);
    const double below = -(p.y - jaw_hinge.y) * line.z + (p.z - jaw_hinge.z) * line.y;
    const double slope = smooth_step(-17, 22, below);
    const double local = 1 - std::pow(std::min(1.0, std::abs(p.x) / mouth_corner_x), 2.5);
    const double side = lip > 0 ? 0 : lip < 0 ? 1 : slope;
    const double share = mix(slope, side, local * smooth_step(50, 70, p.z));
    return share * smooth_step(-14, 58, p.z) * smooth_step(-158, -112, p.y - 0.25 * p.z);
}

class HeadModel {
public:
    explicit HeadModel(const Head& head) : head_(head), lids_(head) {
        const std::size_t n = head.mesh.positions.size();
        jaw_.resize(n);
        for (Index v = 0; v < n; ++v) {
            const VertexTag& tag = head.tags[v];
            if (tag.part == Part::ear) continue;
            const double at_edge = jaw_share(rest(tag.edge), head.tags[tag.edge].lip);
            jaw_[v] = tag.part == Part::mouth_lining ? mix(at_edge, 0.5, smooth_step(0.75, 1, tag.depth))
                                                     : jaw_share(rest(v), tag.lip);
        }
    }

    std::vector<ShapeTarget> all() {
        // Zygomaticus major draws the corner up, out and back around the teeth; the narrow bells keep the middle of the
        // lips level, so that the mouth bends as a bow and not as a V.
        const Pulls smile = {{mouth_corner, {13, 13, 20}, {7.4, 9.0, -6.8}},
                             {{11, -69, 92}, {9, 12, 16}, {1.6, -0.2, -1.4}},
                             {{11, -62, 93}, {13, 4.5, 12}, {0, -1.5, -1.6}, Pull::upper},
                             {{11, -79, 90}, {13, 5.5, 12}, {0, 0.9, -0.4}, Pull::lower},
                             {{36, -38, 66}, {15, 12, 20}, {1.6, 6.0, 5.0}},
                             {{38, -54, 64}, {12, 12, 18}, {2.2, 4.6, 0.2}},
                             {{12, -41, 95}, {5, 6, 10}, {1.3, 0.8, -0.4}},
                             {{0, -92, 90}, {16, 14, 16}, {0, 1.4, -0.2}},
                             {{26, -96, 70}, {17, 14, 20}, {0.4, 2.8, 0.2}},
                             {{31, -17, 74}, {15, 6, 12}, {0, 1.8, 0.8}}};
        const Pulls frown = {{mouth_corner, {13, 12, 18}, {1.2, -6.0, -1.6}},
                             {{11, -69, 92}, {10, 9, 14}, {0, 1.4, 0.2}},
                             {{17, -86, 84}, {12, 9, 14}, {0, -0.4, 1.0}},
                             {{0, -94, 88}, {14, 9, 14}, {0, 1.2, 0.9}}};
        const Pulls dimple = {{mouth_corner, {9.5, 10, 13}, {1.8, 2.8, -5.4}},
                              {{36, -69, 70}, {9, 11, 14}, {-2.4, 1.6, 0}},
                              {{44, -47, 61}, {11, 12, 16}, {1.9, -0.2, 4.0}},
                              {{23, -51, 83}, {7, 7, 10}, {0.9, -0.8, 1.8}},
                              {{20, -86, 82}, {14, 11, 15}, {1.0, 3.2, 0.8}}};
        const Pulls stretch = {{mouth_corner, {12, 12, 17}, {5.6, -1.2, -6.4}},
                               {{46, -86, 34}, {18, 24, 34}, {2.2, 0.3, 0.5}},
                               {{52, -122, -16}, {18, 24, 26}, {1.4, 0.2, 0.1}}};
        const Pulls upper_up = {{{11, -63, 94}, {12, 9, 14}, {0.6, 4.6, 0.4}, Pull::upper},
                                {{14, -45, 92}, {9, 8, 12}, {0.8, 2.0, 0.5}},
                                {{23, -50, 83}, {9, 10, 12}, {1.2, 5.0, -1.4}},
                                {{30, -66, 78}, {9, 9, 13}, {-0.2, 2.8, 0.8}},
                                {{26, -28, 80}, {14, 12, 16}, {0.3, 1.3, 0.6}}};
        const Pulls lower_down = {{{11, -74, 92}, {11, 9, 14}, {0.9, -5.2, -1.4}, Pull::lower},
                                  {{10, -90, 88}, {14, 9, 14}, {0.8, -3.0, -2.0}}};
        const Pulls sneer = {{{10, -28, 94}, {8, 11, 14}, {0.2, 4.4, 1.0}},
                             {{14, -42, 94}, {7, 8, 11}, {1.2, 4.4, 0.2}},
                             {{12, -62, 94}, {9, 8, 12}, {0.4, 3.0, 0.2}, Pull::upper},
                             {{26, -40, 80}, {13, 15, 18}, {-1.0, 5.6, 2.4}},
                             {{36, -60, 70}, {14, 16, 18}, {-1.0, 3.0, 1.8}},
                             {mouth_corner, {12, 11, 15}, {-0.3, 3.0, 0.5}, Pull::upper},
                             {{14, 16, 86}, {16, 9, 16}, {-0.6, -2.6, 0}}};
        const Pulls cheek_raise = {{{35, -28, 70}, {16, 12, 18}, {-0.2, 4.8, 3.0}},
                                   {{33, -15, 75}, {15, 5.5, 12}, {-0.8, 2.8, 1.4}},
                                   {{54, -34, 50}, {15, 16, 20}, {0, 2.4, 2.0}},
                                   {{44, -56, 58}, {15, 13, 18}, {0.8, 2.2, 0.6}},
                                   {{36, 17, 78}, {17, 7, 14}, {0, -1.4, -0.3}}};
        const Pulls cheek_puff = {{{38, -62, 62}, {16, 17, 24}, {5.0, 0.8, 9.0}},
                                  {{18, -58, 88}, {12, 8, 14}, {-0.4, 0.4, 4.5}},
                                  {{18, -82, 85}, {12, 8, 14}, {-0.4, -0.4, 4.5}},
                                  {{26, -69, 84}, {8, 9, 13}, {-1.4, 0, 5.0}}};
        const Pulls brow_down = {{{16, 18, 88}, {12, 8, 14}, {-2.4, -3.6, 1.6}},
                                 {{36, 20, 76}, {16, 8.5, 18}, {-3.6, -3.6, 2.4}},
                                 {{28, 44, 78}, {22, 15, 24}, {-0.9, -1.8, 0.8}},
                                 {{54, 24, 58}, {13, 14, 18}, {-1.2, -0.4, 1.8}}};
        const Pulls brow_inner_up = {{{10, 20, 90}, {13, 9.5, 16}, {0.4, 6.4, 0.4}},
                                     {{28, 23, 84}, {10, 8, 14}, {0.2, 1.6, 0}},
                                     {{0, 3, 90}, {11, 8, 14}, {0, 1.8, 0.1}},
                                     {{0, 46, 90}, {24, 10, 18}, {0, -1.8, 0.8}}};
        const Pulls brow_outer_up = {{{36, 22, 72}, {16, 11, 20}, {0.6, 9.0, -0.4}},
                                     {{36, 42, 72}, {18, 14, 20}, {0, 3.0, 0.2}},
                                     {{36, 11, 78}, {14, 5, 12}, {0, 1.8, 0}}};
        const Pulls press = {{{14, -60, 92}, {12, 5, 14}, {-0.2, -1.3, 0.2}, Pull::upper},
                             {{14, -78, 91}, {12, 6, 14}, {0, 2.0, 1.0}, Pull::lower},
                             {{8, -96, 86}, {14, 11, 15}, {0, 3.2, 1.7}},
                             {{29, -68, 80}, {9, 9, 12}, {0.2, 1.4, 1.4}}};
        const Pulls pucker = {{mouth_corner, {14, 15, 18}, {-8.0, 0.4, 6.0}},
                              {{12, -68, 92}, {9, 11, 14}, {-2.2, 0, 4.0}},
                              {{40, -60, 62}, {14, 15, 20}, {-1.0, 0.8, 2.6}},
                              {{0, -64, 95}, {11, 6, 14}, {0, 0, 3.2}, Pull::upper},
                              {{0, -75, 93}, {11, 7, 14}, {0, 0, 3.2}, Pull::lower}};
        const Pulls funnel = {{mouth_corner, {13, 14, 18}, {-5.0, 0, 5.6}},
                              {{13, -62, 93}, {11, 9, 14}, {-1.0, 3.2, 3.8}, Pull::upper},
                              {{0, -62, 95}, {9, 8, 14}, {0, 2.2, 2.4}, Pull::upper},
                              {{13, -76, 91}, {11, 9, 14}, {-0.8, -4.8, 2.8}, Pull::lower},
                              {{0, -77, 92}, {9, 8, 14}, {0, -3.8, 1.6}, Pull::lower},
                              {{0, -95, 87}, {15, 11, 15}, {0, -1.6, -1.2}}};
        const Pulls roll_upper = {{{0, -57, 95}, {24, 6, 14}, {0, -3.4, -0.8}, Pull::upper},
                                  {{0, -65, 94}, {22, 6, 14}, {0, -0.6, -5.0}, Pull::upper}};
        const Pulls roll_lower = {{{0, -80, 92}, {21, 6.5, 14}, {0, 6.0, 0.6}, Pull::lower},
                                  {{0, -73, 93}, {21, 6.5, 14}, {0, 1.6, -5.0}, Pull::lower},
                                  {{0, -97, 87}, {16, 10, 15}, {0, 1.4, 1.6}}};
        const Pulls shrug_upper = {{{0, -60, 95}, {17, 7, 14}, {0, 1.8, 1.8}, Pull::upper},
                                   {{0, -68, 94}, {19, 11, 14}, {0, 2.8, 0.6}}};
        const Pulls shrug_lower = {{{0, -79, 92}, {19, 9, 14}, {0, 2.6, 3.6}, Pull::lower},
                                   {{0, -96, 88}, {20, 14, 17}, {0, 8.0, 2.4}},
                                   {{0, -70, 94}, {21, 8, 14}, {0, 2.2, 1.4}, Pull::lower},
                                   {{0, -66, 94}, {20, 7, 14}, {0, 1.4, 0.8}, Pull::upper}};
        const Pulls mouth_left = {
            {{1, -69, 91}, {20, 16, 20}, {11.6, 0.4, -2.2}},  {{27, -66, 82}, {12, 13, 17}, {1.0, 3.4, -2.4}},
            {{36, -46, 68}, {16, 15, 20}, {1.0, 2.4, 0.6}},   {{-27, -69, 79}, {13, 14, 18}, {7.4, -0.8, 6.6}},
            {{-42, -64, 60}, {14, 16, 20}, {3.4, -0.8, 4.4}}, {{3, -95, 86}, {18, 12, 16}, {3.0, 0.6, -0.2}},
            {{0, -38, 108}, {10, 8, 12}, {1.4, 0.3, 0}}};

        add_sides("browDown", [&](Index v) { return pulled(v, brow_down); });
        add_whole("browInnerUp", [&](Index v) { return pulled(v, both_sides(brow_inner_up)); });
        add_sides("browOuterUp", [&](Index v) { return pulled(v, brow_outer_up); });
        add_whole("cheekPuff", [&](Index v) { return pulled(v, both_sides(cheek_puff)); });
        add_sides("cheekSquint", [&](Index v) { return pulled(v, cheek_raise); });
        add_sides("eyeBlink", [&](Index v) { return lids_.move(v, {.close = 1}); });
        add_sides("eyeLookDown", [&](Index v) { return lids_.move(v, {.upper_degrees = -22, .lower_degrees = -6}); });
        add_sides("eyeLookIn", [&](Index v) { return lids_.move(v, {.yaw_degrees = -7}); });
        add_sides("eyeLookOut", [&](Index v) { return lids_.move(v, {.yaw_degrees = 7}); });
        add_sides("eyeLookUp", [&](Index v) { return lids_.move(v, {.upper_degrees = 12, .lower_degrees = 4.5}); });
        add_sides("eyeSquint", [&](Index v) {
            return lids_.move(v, {.upper_degrees = -4, .lower_degrees = 12, .sideways_mm = -1.0}) +
                   pulled(v, cheek_raise * 0.35);
        });
        add_sides("eyeWide", [&](Index v) { return lids_.move(v, {.upper_degrees = 8, .lower_degrees = -2}); });
        add_whole("jawForward", [&](Index v) { return jaw_[v] * Vec3(0, -0.6, 6); });
        add_sides("jaw", [&](Index v) { return jaw_[v] * Vec3(7, 0, 0); });
        add_whole("jawOpen", [&](Index v) { return jaw_opened(rest(v), jaw_[v]) - rest(v); });
        add_whole("mouthClose", [&](Index v) { return mouth_closing(v); });
        add_sides("mouthDimple", [&](Index v) { return pulled(v, dimple); });
        add_sides("mouthFrown", [&](Index v) { return pulled(v, frown); });
        add_whole("mouthFunnel", [&](Index v) { return pulled(v, both_sides(funnel)); });
        add_sides("mouth", [&](Index v) { return pulled(v, mouth_left); });
        add_sides("mouthLowerDown", [&](Index v) { return pulled(v, lower_down); });
        add_sides("mouthPress", [&](Index v) { return pulled(v, press); });
        add_whole("mouthPucker", [&](Index v) { return pulled(v, both_sides(pucker)); });
        add_whole("mouthRollLower", [&](Index v) { return pulled(v, roll_lower); });
        add_whole("mouthRollUpper", [&](Index v) { return pulled(v, roll_upper); });
        add_whole("mouthShrugLower", [&](Index v) { return pulled(v, shrug_lower); });
        add_whole("mouthShrugUpper", [&](Index v) { return pulled(v, shrug_upper); });
        add_sides("mouthSmile", [&](Index v) { return pulled(v, smile * 0.88) + folded(v, 1); });
        add_sides("mouthStretch", [&](Index v) { return pulled(v, stretch); });
        add_sides("mouthUpperUp", [&](Index v) { return pulled(v, upper_up); });
        add_sides("noseSneer", [&](Index v) { return pulled(v, sneer) + folded(v, 0.5); });
        return std::move(targets_);
    }

private:
    using Move = std::function<Vec3(Index)>;

    const Vec3& rest(Index v) const { return head_.mesh.positions[v]; }

    Vec3 pulled(Index v, const Pulls& pulls) const {
        const VertexTag& tag = head_.tags[v];
        if (tag.part == Part::ear) return Vec3(0);
        const bool lining = tag.part == Part::mouth_lining;
        // A lining goes with the edge that it hangs on, less and less inward; the eyes' linings stay with the lids.
        const Vec3 p = tag.part == Part::skin ? rest(v) : rest(tag.edge);
        const int lip = lining ? head_.tags[tag.edge].lip : tag.lip;
        const double hold = lining ? smooth_step(0.75, 0.1, tag.depth) : 1;
        Vec3 sum(0);
        for (const Pull& pull : pulls) {
            // Skin is one sheet: what a muscle pulls drags its surroundings along, on its own side of the face.
            constexpr double drag = 0.35, drag_reach = 2.3;
            const double side = std::abs(pull.centre.x) < 6 ? 1 : smooth_step(-14, 8, pull.centre.x > 0 ? p.x : -p.x);
            double strength = hold * ((1 - drag) * bell(p, pull.centre, pull.widths) +
                                      drag * side * bell(p, pull.centre, pull.widths * drag_reach));
            if (strength < 1e-4) continue;
            if (pull.lips == Pull::upper) strength *= upper_share(p, lip, 7);
            if (pull.lips == Pull::lower) strength *= 1 - upper_share(p, lip, 7);
            sum += strength * pull.move;
        }
        return sum;
    }

    /// The nasolabial fold: a crease from the wing of the nose past the mouth's corner, and the cheek that bulges over
    /// it, along the skin's normal.
    Vec3 folded(Index v, double strength) const {
        // Deep and narrow beside the wing of the nose, shallow and wide beside the mouth.
        constexpr double bulge_mm = 3.0, bulge_width = 8;
        constexpr Vec2 line[] = {{14.5, -33}, {18, -42}, {23, -52}, {29, -62}, {32.5, -73}};
        if (head_.tags[v].part != Part::skin || rest(v).x < 0 || rest(v).z < 35) return Vec3(0);
        const Vec2 p(rest(v).x, rest(v).y);
        double nearest = 1e9, side = 0, along = 0;
        for (std::size_t k = 0; k + 1 < std::size(line); ++k) {
            const Vec2 way = line[k + 1] - line[k], arm = p - line[k];
            const double t = std::clamp(glm::dot(arm, way) / glm::dot(way, way), 0.0, 1.0);
            const double distance = glm::length(arm - way * t);
            if (distance >= nearest) continue;
            nearest = distance;
            side = way.x * arm.y - way.y * arm.x;
            along = (static_cast<double>(k) + t) / (std::size(line) - 1);
        }
        const double fade = smooth_step(0, 0.15, along) * smooth_step(1, 0.65, along);
        const double toward_cheek = side > 0 ? nearest : -nearest;
        const double groove_mm = mix(2.6, 1.3, along), groove_width = mix(2.0, 4.4, along);
        const double height =
            bulge_mm * bell(toward_cheek - bulge_width, bulge_width) - groove_mm * bell(toward_cheek, groove_width);
        return head_.mesh.normals[v] * (strength * fade * height);
    }

    /// With jawOpen at 1 this brings the lips' edges together again: each goes its share of the gap that the jaw
    /// opened.
    Vec3 mouth_closing(Index v) const {
        constexpr double upper_part = 0.12;
        const VertexTag& tag = head_.tags[v];
        if (tag.part == Part::ear) return Vec3(0);
        const Vec3& p = rest(tag.part == Part::mouth_lining ? tag.edge : v);
        const int lip = head_.tags[tag.part == Part::mouth_lining ? tag.edge : v].lip;
        const double x = std::abs(p.x);
        const auto& upper = head_.upper_lip;
        std::size_t k = 0;
        while (k + 2 < upper.size() && rest(upper[k + 1]).x < x) ++k;
        const double span = rest(upper[k + 1]).x - rest(upper[k]).x;
        const double t = std::clamp((x - rest(upper[k]).x) / span, 0.0, 1.0);
        const auto gap_at = [&](std::size_t n) {
            const Vec3& edge = rest(upper[n]);
            return jaw_opened(edge, jaw_[head_.lower_lip[n]]) - jaw_opened(edge, jaw_[upper[n]]);
        };
        Vec3 gap = glm::mix(gap_at(k), gap_at(k + 1), t);
        gap.x = 0;
        const double off = p.y - lip_line_y(p.x);
        const double hold = tag.part == Part::mouth_lining ? smooth_step(0.9, 0.2, tag.depth) : 1;
        const double front = smooth_step(50, 72, p.z) * hold;
        if (lip > 0) return gap * (upper_part * square(std::max(0.0, 1 - off / 24)) * front);
        if (lip < 0) return -gap * ((1 - upper_part) * std::pow(std::max(0.0, 1 + off / 44), 1.4) * front);
        return Vec3(0);
    }

    /// Lips and cheeks slide over the teeth and do not enter them; the lower ones go with the jaw.
    void keep_off_teeth(const std::string& name, std::vector<Vec3>& deltas) const {
        constexpr double clearance_mm = 0.4;
        const double jaw = name == "jawOpen" ? 1 : 0;
        for (Index v = 0; v < deltas.size(); ++v) {
            if (deltas[v] == Vec3(0) || head_.tags[v].part == Part::ear || head_.tags[v].part == Part::lid_lining)
                continue;
            for (const Jaw row : {Jaw::upper, Jaw::lower}) {
                if (depth_in_teeth(row, rest(v), clearance_mm) > 0) continue;  // the lining behind the gums
                const double opened = row == Jaw::lower ? jaw : 0;
                const Vec3 end = jaw_opened(rest(v) + deltas[v], -opened);
                if (depth_in_teeth(row, end, clearance_mm) == 0) continue;
                deltas[v] = jaw_opened(before_teeth(row, end, clearance_mm), opened) - rest(v);
            }
        }
    }

    void add(const std::string& name, std::vector<Vec3> deltas) {
        lids_.keep_off_eyes(deltas);
        keep_off_teeth(name, deltas);
        if (name == "eyeBlinkLeft") lids_.join_edges(deltas);
        ShapeTarget target;
        target.name = name;
        target.position_deltas = std::move(deltas);
        std::vector<Vec3> moved(head_.mesh.positions);
        for (Index v = 0; v < moved.size(); ++v) moved[v] += target.position_deltas[v];
        target.normal_deltas = head_normals(head_, moved);
        for (Index v = 0; v < moved.size(); ++v) target.normal_deltas[v] -= head_.mesh.normals[v];
        targets_.push_back(std::move(target));
    }

    std::vector<Vec3> evaluate(const Move& move) const {
        std::vector<Vec3> deltas(head_.mesh.positions.size());
        for (Index v = 0; v < deltas.size(); ++v) deltas[v] = move(v);
        return deltas;
    }

    /// A shape of both halves at once: the left half is computed, the right one copied.
    void add_whole(const std::string& name, const Move& move) {
        std::vector<Vec3> deltas = evaluate(move);
        symmetrise(deltas);
        add(name, std::move(deltas));
        ShapeTarget& target = targets_.back();
        symmetrise(target.position_deltas);
        symmetrise(target.normal_deltas);
    }
    void symmetrise(std::vector<Vec3>& deltas) const {
        for (Index v = 0; v < deltas.size(); ++v) {
            if (head_.image[v] == v) deltas[v].x = 0;
            if (rest(v).x < 0 || (rest(v).x == 0 && head_.image[v] < v)) deltas[v] = mirrored(deltas[head_.image[v]]);
        }
    }

    /// A shape of one side and its mirror image.
    void add_sides(const std::string& name, const Move& left) {
        add(name + "Left", evaluate(left));
        const ShapeTarget& target = targets_.back();
        ShapeTarget right = target;
        right.name = name + "Right";
        for (Index v = 0; v < head_.image.size(); ++v) {
            right.position_deltas[v] = mirrored(target.position_deltas[head_.image[v]]);
            right.normal_deltas[v] = mirrored(target.normal_deltas[head_.image[v]]);
        }
        targets_.push_back(std::move(right));
    }

    const Head& head_;
    Lids lids_;
    std::vector<double> jaw_;
    std::vector<ShapeTarget> targets_;
};

}  // namespace

Vec3 jaw_opened(const Vec3& p, double share) {
    const double angle = jaw_open_angle * share;
    const Vec3 arm = p - jaw_hinge;
    return jaw_hinge + Vec3(arm.x, arm.y * std::cos(angle) - arm.z * std::sin(angle),
                            arm.y * std::sin(angle) + arm.z * std::cos(angle));
}

std::vector<ShapeTarget> head_targets(const Head& head) { return HeadModel(head).all(); }

namespace {
template <class Move>
ShapeTarget rigid_target(const Mesh& mesh, const std::string& name, Move move) {
    ShapeTarget target;
    target.name = name;
    Mesh moved = mesh;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3 delta = move(mesh.positions[v]);
        target.position_deltas.push_back(delta);
        moved.positions[v] += delta;
    }
    target.normal_deltas = smooth_normals(moved);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) target.normal_deltas[v] -= mesh.normals[v];
    return target;
}
}  // namespace

std::vector<ShapeTarget> mandible_targets(const Mesh& mesh) {
    return {rigid_target(mesh, "jawForward", [](const Vec3&) { return Vec3(0, -0.6, 6); }),
            rigid_target(mesh, "jawLeft", [](const Vec3&) { return Vec3(7, 0, 0); }),
            rigid_target(mesh, "jawOpen", [](const Vec3& p) { return jaw_opened(p, 1) - p; }),
            rigid_target(mesh, "jawRight", [](const Vec3&) { return Vec3(-7, 0, 0); })};
}

std::vector<ShapeTarget> tongue_targets(const Mesh& tongue) {
    std::vector<ShapeTarget> targets = mandible_targets(tongue);
    targets.push_back(rigid_target(tongue, "tongueOut", [](const Vec3& p) { return tongue_out(p); }));
    return targets;
}

std::vector<ShapeTarget> lash_targets(const Lashes& lashes, const Head& head, const std::vector<ShapeTarget>& all) {
    std::vector<ShapeTarget> targets;
    const Lids lids(head);
    for (const ShapeTarget& source : all) {
        ShapeTarget target;
        target.name = source.name;
        bool moves = false;
        for (std::size_t v = 0; v < lashes.edge.size(); ++v) {
            const Index edge = lashes.edge[v];
            const Vec3 delta = source.position_deltas[edge];
            const Vec3 p = lashes.mesh.positions[v];
            // A lash turns as its root turns about the eye.
            const Vec3 moved = lids.carried(head.mesh.positions[edge], delta, p);
            target.position_deltas.push_back(moved - p);
            target.normal_deltas.push_back(Vec3(0));
            moves = moves || glm::length(delta) > 0.01;
        }
        if (!moves) continue;
        Mesh deformed = lashes.mesh;
        for (std::size_t v = 0; v < lashes.edge.size(); ++v) deformed.positions[v] += target.position_deltas[v];
        const std::vector<Vec3> normals = smooth_normals(deformed);
        for (std::size_t v = 0; v < lashes.edge.size(); ++v)
            target.normal_deltas[v] = normals[v] - lashes.mesh.normals[v];
        targets.push_back(std::move(target));
    }
    return targets;
}

}  // namespace blush::make_face
