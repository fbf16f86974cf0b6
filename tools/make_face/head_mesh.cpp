#include "tools/make_face/head_mesh.h"

#include <functional>

#include "tools/make_face/coarse_head.h"
#include "tools/make_face/ear.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

using namespace landmark;

// The texture: the chart stands in the middle, ears and the mouth's inside lie in corners that it leaves free.
constexpr double texture_per_mm = 1 / 340.0, chart_bottom_v = 0.93;
constexpr Vec2 ear_uv_corner{0.80, 0.01};
constexpr double ear_uv_side = 0.19;
constexpr Vec2 mouth_uv_half{0.11, 0.07};
constexpr double mouth_uv_y = 0.10;
constexpr Vec2 cut_uv{0.635, 0.10};  // where the cut's middle lies
constexpr double cut_uv_per_mm = 0.001;

/// Catmull and Rom's cubic through places at 0, 1, 2, ...
Vec3 along(std::span<const Vec3> places, double s) {
    const auto last = static_cast<int>(places.size()) - 1;
    const int k = std::clamp(static_cast<int>(std::floor(s)), 0, last - 1);
    const auto at = [&](int n) { return places[static_cast<std::size_t>(std::clamp(n, 0, last))]; };
    const Vec3 a = at(k - 1), b = at(k), c = at(k + 1), d = at(k + 2);
    const double t = s - k;
    return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

/// Samples the left half at the lines of a finer or coarser grid, and hangs linings and the ear on it.
class HalfHead {
public:
    HalfHead(const CoarseHead& coarse, double fineness, Head& head)
        : coarse_(coarse), grid_(make_grid(fineness)), fineness_(fineness), head_(head) {
        number_vertices();
        sample();
        store();
        line_lids();
        line_mouth();
        close_bust();
        add_left_ear(head_.mesh, fineness, ear_uv_corner, ear_uv_side);
        VertexTag ear;
        ear.part = Part::ear;
        head_.tags.resize(head_.mesh.positions.size(), ear);
        for (Index v = 0; v < head_.tags.size(); ++v)
            if (head_.tags[v].part == Part::ear) head_.tags[v].edge = v;
    }
    std::vector<char> on_seam() const {
        std::vector<char> seam(head_.mesh.positions.size(), 0);
        for (int j = 0; j < grid_.last_row(); ++j) seam[id(grid_.last_column(), j)] = 1;
        for (const Index v : poles()) seam[v] = 1;
        for (Index v = 0; v < seam.size(); ++v)
            if (head_.tags[v].part == Part::cut && head_.mesh.positions[v].x == 0) seam[v] = 1;
        return seam;
    }
    /// The copies of the pole, one a column.
    std::vector<Index> poles() const {
        std::vector<Index> all;
        for (int i = 0; i <= grid_.last_column(); ++i) all.push_back(id(i, grid_.last_row()));
        return all;
    }
    /// Vertices that the texture's seam at the lips has doubled, with their originals.
    const std::vector<std::pair<Index, Index>>& doubled() const { return doubled_; }

private:
    Index id(int i, int j) const {
        return lower_[static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i)];
    }
    Index upper_id(int i, int j) const {
        return upper_[static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i)];
    }

    /// A vertex on a slit exists twice: `lower` belongs to the row below, `upper` to the row above. The last row
    /// lies on one pole, a copy for each column: a shared one would stretch the texture of its triangles to a smear.
    void number_vertices() {
        columns_ = static_cast<std::size_t>(grid_.last_column() + 1);
        const std::size_t cells = columns_ * static_cast<std::size_t>(grid_.last_row() + 1);
        lower_.resize(cells);
        upper_.resize(cells);
        Index next = 0;
        for (int j = 0; j <= grid_.last_row(); ++j) {
            for (int i = 0; i <= grid_.last_column(); ++i) {
                const std::size_t cell = static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i);
                lower_[cell] = next++;
                upper_[cell] = grid_.slit(i, j) ? next++ : lower_[cell];
            }
        }
        positions_.resize(next);
        uv_.resize(next);
    }

    /// Where this grid's line stands among the coarse one's: even steps between the features that both have.
    static std::vector<double> lines_in(const std::vector<int>& fine, const std::vector<int>& coarse) {
        std::vector<double> place(static_cast<std::size_t>(fine.back()) + 1, 0.0);
        for (std::size_t n = 0; n + 1 < fine.size(); ++n) {
            for (int k = fine[n]; k <= fine[n + 1]; ++k) {
                const double t = static_cast<double>(k - fine[n]) / (fine[n + 1] - fine[n]);
                place[static_cast<std::size_t>(k)] = mix(coarse[n], coarse[n + 1], t);
            }
        }
        return place;
    }
    static std::vector<int> column_features(const Grid& g) {
        return {0, g.inner_canthus, g.mouth_corner, g.outer_canthus, g.last_column()};
    }
    static std::vector<int> row_features(const Grid& g) { return {0, g.chin, g.mouth, g.eye, g.brow, g.last_row()}; }

    void sample() {
        const std::vector<double> columns = lines_in(column_features(grid_), column_features(coarse_.grid())),
                                  rows = lines_in(row_features(grid_), row_features(coarse_.grid()));
        const auto take = [&](Index v, int i, int j, bool above) {
            const auto column = static_cast<std::size_t>(i), row = static_cast<std::size_t>(j);
            const CoarseHead::Sample sample = coarse_.at(columns[column], rows[row], above);
            // The cut's edge, the pole and where the lips meet stay where they are; all else returns to the surface.
            const bool held = j == 0 || j == grid_.last_row() || (j == grid_.mouth && i <= grid_.mouth_corner);
            positions_[v] = held ? sample.position : sink_nostril(project_to_head(sample.position));
            if (i == 0 || i == grid_.last_column() || j == grid_.last_row()) positions_[v].x = 0;
            uv_[v] = to_texture(sample.flat);
        };
        parallel_pieces(grid_.last_row() + 1, [&](int first, int last) {
            for (int j = first; j < last; ++j) {
                for (int i = 0; i <= grid_.last_column(); ++i) {
                    take(id(i, j), i, j, false);
                    if (grid_.slit(i, j)) take(upper_id(i, j), i, j, true);
                }
            }
        });
        for (int i = 1; i <= grid_.last_column(); ++i)
            positions_[id(i, grid_.last_row())] = positions_[id(0, grid_.last_row())];
        // The lips' edges are one line.
        for (int i = 0; i <= grid_.mouth_corner; ++i)
            positions_[upper_id(i, grid_.mouth)] = positions_[id(i, grid_.mouth)];
    }

    /// The chart stands upright in the texture's middle; millimetres times one factor.
    static Vec2 to_texture(const Vec2& flat) {
        return {0.5 + flat.x * texture_per_mm, chart_bottom_v - flat.y * texture_per_mm};
    }

    void store() {
        head_.mesh.positions = positions_;
        head_.mesh.uv = uv_;
        head_.tags.resize(positions_.size());
        for (int j = 0; j <= grid_.last_row(); ++j) {
            for (int i = 0; i <= grid_.last_column(); ++i) {
                for (const Index v : {id(i, j), upper_id(i, j)}) {
                    VertexTag& tag = head_.tags[v];
                    tag.edge = v;
                    const bool is_upper_copy = v == upper_id(i, j) && v != id(i, j);
                    tag.lip = j > grid_.mouth      ? 1
                              : j < grid_.mouth    ? -1
                              : !grid_.in_mouth(i) ? 0
                              : is_upper_copy      ? 1
                                                   : -1;
                    tag.lid = j > grid_.eye ? 1 : j < grid_.eye ? -1 : !grid_.in_eye(i) ? 0 : is_upper_copy ? 1 : -1;
                }
                if (i == grid_.last_column() || j == grid_.last_row()) continue;
                if (j + 1 == grid_.last_row())
                    head_.mesh.triangles.push_back({upper_id(i, j), upper_id(i + 1, j), id(i, j + 1)});
                else
                    head_.mesh.add_quad(upper_id(i, j), upper_id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
            }
        }
        for (int i = grid_.inner_canthus; i <= grid_.outer_canthus; ++i) {
            head_.upper_lid.push_back(upper_id(i, grid_.eye));
            head_.lower_lid.push_back(id(i, grid_.eye));
        }
        for (int i = 0; i <= grid_.mouth_corner; ++i) {
            head_.upper_lip.push_back(upper_id(i, grid_.mouth));
            head_.lower_lip.push_back(id(i, grid_.mouth));
        }
    }

    /// Adds rings inward from an upper and a lower edge; `place(k, side, depth)` and `texture(k, side, depth)` give a
    /// vertex (depth 0 at the edge, 1 innermost), the two sides share their vertices where `shared(k, depth)`.
    template <class Place, class Texture, class Shared>
    void add_lining(std::vector<Index> previous_upper, std::vector<Index> previous_lower, int rings, Part part,
                    Place place, Texture texture, Shared shared) {
        const std::vector<Index> upper = previous_upper, lower = previous_lower;
        const std::size_t n = upper.size();
        for (int ring = 1; ring <= rings; ++ring) {
            const double depth = static_cast<double>(ring) / rings;
            std::vector<Index> next_upper(n), next_lower(n);
            for (std::size_t k = 0; k < n; ++k) {
                const auto add = [&](int side, Index edge) {
                    VertexTag tag;
                    tag.part = part;
                    tag.depth = depth;
                    tag.edge = head_.tags[edge].edge;
                    (part == Part::lid_lining ? tag.lid : tag.lip) = side;
                    if (part == Part::lid_lining) tag.lip = 1;
                    head_.tags.push_back(tag);
                    return head_.mesh.add(place(k, side, depth), texture(k, side, depth));
                };
                const bool one = shared(k, depth);
                next_upper[k] = add(one ? 0 : 1, upper[k]);
                next_lower[k] = one ? next_upper[k] : add(-1, lower[k]);
            }
            for (std::size_t k = 0; k + 1 < n; ++k) {
                head_.mesh.add_quad(next_upper[k], next_upper[k + 1], previous_upper[k + 1], previous_upper[k]);
                head_.mesh.add_quad(previous_lower[k], previous_lower[k + 1], next_lower[k + 1], next_lower[k]);
            }
            previous_upper = next_upper;
            previous_lower = next_lower;
        }
    }

    /// The lid's margin turns in to the eyeball, then runs back along it.
    void line_lids() {
        constexpr int knots = 4;
        constexpr double sealed_inside =
            -1.0;  // the last ring lies in the eyeball, so that no gap shows behind the lids

        constexpr double clearance[knots + 1] = {0, 1.25, 0.45, 0.6, sealed_inside};  // millimetres over the eyeball
        constexpr double turn_degrees[knots + 1] = {0, 0.0, 1.0, 9, 26};              // away from the opening
        const std::size_t last = head_.upper_lid.size() - 1;
        const auto at_knot = [&](std::size_t k, int side, int knot) {
            const Vec3 edge = head_.mesh.positions[side >= 0 ? head_.upper_lid[k] : head_.lower_lid[k]];
            if (knot == 0) return edge;
            const Vec3 arm = edge - eye_centre;
            const double reach = glm::length(arm);
            if (side == 0) {  // the corners go straight back along the ball
                const Vec3 back = arm - Vec3(0, 0, 0.5 * knot);
                const double length =
                    knot == knots ? eye_radius + sealed_inside : std::max(glm::length(back), eye_radius + 0.4);
                return eye_centre + back * (length / glm::length(back));
            }
            const double radius = std::min(reach, eye_radius + clearance[knot]);
            const double turn = radians(turn_degrees[knot]) * side;
            // A lid turns about the horizontal axis through the eye's centre.
            const Vec3 turned(arm.x, arm.y * std::cos(turn) + arm.z * std::sin(turn),
                              arm.z * std::cos(turn) - arm.y * std::sin(turn));
            return eye_centre + turned * (radius / reach);
        };
        const auto place = [&](std::size_t k, int side, double depth) {
            std::array<Vec3, knots + 1> curve;
            for (int n = 0; n <= knots; ++n)
                curve[static_cast<std::size_t>(n)] = at_knot(k, k == 0 || k == last ? 0 : side, n);
            return along(curve, depth * knots);
        };
        // In the texture the rings fill the eye's opening, toward the middle between both edges.
        const auto texture = [&](std::size_t k, int side, double depth) {
            const Vec2 up = head_.mesh.uv[head_.upper_lid[k]], low = head_.mesh.uv[head_.lower_lid[k]];
            return glm::mix(side >= 0 ? up : low, 0.5 * (up + low), 0.9 * depth);
        };
        add_lining(head_.upper_lid, head_.lower_lid, std::max(4, static_cast<int>(std::lround(knots * fineness_))),
                   Part::lid_lining, place, texture, [&](std::size_t k, double) { return k == 0 || k == last; });
    }

    /// The lips turn in, line the vestibule in front of the teeth and close behind them as palate and floor. In the
    /// texture that is an island of its own; its edge doubles the lips'.
    void line_mouth() {
        constexpr int knots = 9;
        const std::size_t last = head_.upper_lip.size() - 1;
        const auto at_knot = [&](std::size_t k, int side, int knot) {
            const Vec3 edge = head_.mesh.positions[head_.upper_lip[k]];
            const double t = static_cast<double>(k) / static_cast<double>(last);
            const double open = std::sqrt(std::max(0.0, 1 - std::pow(t, 4)));  // the sides meet behind the corner
            const double angle = t * pi / 2;
            // Seen from above, the vestibule is half an ellipse outside the dental arch.
            const auto arch = [&](double half_width, double front) {
                return Vec3(half_width * std::sin(angle), edge.y, 46 + (front - 46) * std::cos(angle));
            };
            const auto raised = [&](const Vec3& p, double height) { return p + Vec3(0, side * height * open, 0); };
            // Below, it stays behind the fold between lip and chin, which a smile and the open jaw draw back.
            const double behind_fold = side < 0 ? 1 : 0;
            const Vec3 wall = arch(35, 87.2 - 4.6 * behind_fold);
            switch (knot) {
                case 0:
                    return edge;
                case 1:
                    return raised(edge + Vec3(0, 0, -1.6), 0.25);
                case 2:
                    return raised(glm::mix(edge + Vec3(0, 0, -3.4), wall, 0.12), 1.2);
                case 3:
                    return raised(glm::mix(edge + Vec3(0, 0, -4.6), wall, 0.4), 4);
                case 4:
                    return raised(wall, 8.5);
                case 5:
                    return raised(wall + Vec3(0, 0, 0.4 - behind_fold), 13);
                case 6:
                    return raised(arch(33, 84 - 4 * behind_fold), 16.5);
                case 7:
                    return raised(arch(26, 76), 18);
                case 8:
                    return raised(arch(15, 64), 17);
                default:
                    return arch(4, 40);
            }
        };
        const auto place = [&](std::size_t k, int side, double depth) {
            std::array<Vec3, knots + 1> curve;
            for (int n = 0; n <= knots; ++n) curve[static_cast<std::size_t>(n)] = at_knot(k, side, n);
            Vec3 p = along(curve, depth * knots);
            if (k == 0) p.x = 0;
            return p;
        };
        const auto texture = [&](std::size_t k, int side, double depth) {
            const double t = static_cast<double>(k) / static_cast<double>(last);
            const double open = std::sqrt(std::max(0.0, 1 - std::pow(t, 4)));
            return Vec2(0.5 + mouth_uv_half.x * t * (1 - 0.4 * depth),
                        mouth_uv_y - side * mouth_uv_half.y * open * (1 - depth));
        };
        const auto doubled_edge = [&](const std::vector<Index>& edge, int side) {
            std::vector<Index> twins;
            for (std::size_t k = 0; k < edge.size(); ++k) {
                VertexTag tag = head_.tags[edge[k]];
                tag.part = Part::mouth_lining;
                tag.edge = edge[k];
                head_.tags.push_back(tag);
                twins.push_back(head_.mesh.add(head_.mesh.positions[edge[k]], texture(k, side, 0)));
                doubled_.emplace_back(twins.back(), edge[k]);
            }
            return twins;
        };
        const std::vector<Index> upper = doubled_edge(head_.upper_lip, 1);
        std::vector<Index> lower = doubled_edge({head_.lower_lip.begin(), head_.lower_lip.end() - 1}, -1);
        lower.push_back(upper.back());  // the corner is one place
        add_lining(upper, lower, std::max(7, static_cast<int>(std::lround(knots * fineness_))), Part::mouth_lining,
                   place, texture, [&](std::size_t k, double depth) { return k == last || depth == 1; });
    }

    /// A level face inside the edge of the cut. Its rim doubles the skin's, so that the edge is a sharp one.
    void close_bust() {
        const int rings = std::max(2, static_cast<int>(std::lround(3 * fineness_)));
        const Vec3 middle{0, positions_[id(0, 0)].y,
                          mix(positions_[id(0, 0)].z, positions_[id(grid_.last_column(), 0)].z, 0.5)};
        const auto add = [&](const Vec3& p) {
            const Index v = head_.mesh.add(p, cut_uv + cut_uv_per_mm * Vec2(p.x, middle.z - p.z));
            VertexTag tag;
            tag.part = Part::cut;
            tag.edge = v;
            tag.lip = tag.lid = -1;
            head_.tags.push_back(tag);
            return v;
        };
        std::vector<Index> outer;
        for (int i = 0; i <= grid_.last_column(); ++i) outer.push_back(add(positions_[id(i, 0)]));
        for (int ring = 1; ring <= rings; ++ring) {
            const double inward = static_cast<double>(ring) / rings;
            std::vector<Index> inner;
            for (std::size_t i = 0; i < outer.size(); ++i) {
                const bool one = ring == rings && i > 0;
                inner.push_back(one ? inner.front()
                                    : add(glm::mix(positions_[id(static_cast<int>(i), 0)], middle, inward)));
            }
            for (std::size_t i = 0; i + 1 < outer.size(); ++i)
                head_.mesh.add_quad(inner[i], inner[i + 1], outer[i + 1], outer[i]);
            outer = inner;
        }
    }

    const CoarseHead& coarse_;
    Grid grid_;
    double fineness_;
    Head& head_;
    std::size_t columns_ = 0;
    std::vector<Index> lower_, upper_;
    std::vector<Vec3> positions_;
    std::vector<Vec2> uv_;
    std::vector<std::pair<Index, Index>> doubled_;
};

}  // namespace

Head make_head(std::size_t vertices) {
    constexpr double vertices_at_fineness_1 = 26'500;  // counted; both halves, ears and linings
    const double fineness =
        std::sqrt(static_cast<double>(std::clamp(vertices, least_vertices, most_vertices)) / vertices_at_fineness_1);
    static const CoarseHead coarse;
    Head head;
    const HalfHead half(coarse, fineness, head);
    const std::vector<char> seam = half.on_seam();
    const std::size_t half_count = head.mesh.positions.size();

    std::vector<char> apart(seam);
    head.image = mirror_across_x(head.mesh, std::span<const char>(apart));
    head.tags.resize(head.mesh.positions.size());
    head.weld.resize(head.mesh.positions.size());
    for (Index v = 0; v < head.weld.size(); ++v) head.weld[v] = v;
    for (Index v = 0; v < half_count; ++v) {
        const Index w = head.image[v];
        if (w != v) {
            head.tags[w] = head.tags[v];
            head.tags[w].edge = head.image[head.tags[v].edge];
        }
        if (seam[v]) head.weld[w] = v;
    }
    const std::vector<Index> poles = half.poles();
    for (const Index v : poles) head.weld[v] = head.weld[head.image[v]] = poles.front();
    for (const auto& [twin, original] : half.doubled()) {
        head.weld[twin] = original;
        head.weld[head.image[twin]] = head.image[original];
    }
    head.mesh.normals = head_normals(head, head.mesh.positions);
    return head;
}

std::vector<Vec3> head_normals(const Head& head, std::span<const Vec3> positions) {
    return smooth_normals(positions, head.mesh.triangles, head.weld);
}

}  // namespace blush::make_face
