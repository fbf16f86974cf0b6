#include "tools/make_face/head_mesh.h"

#include <numeric>

#include "tools/make_face/ear.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

using namespace landmark;

constexpr Vec3 neck_end_centre{0, -156, -33};
constexpr double chin_elevation = radians(-49), brow_elevation = radians(28);

/// The strip of the texture above the face holds the ears; the face has the rest.
constexpr double face_v_top = 0.17;  // a margin of bare texels keeps the ears out of the crown's mip levels
constexpr double ear_uv_side = 0.145;

Vec3 direction(double azimuth, double elevation) {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}
double azimuth_of(const Vec3& p) { return std::atan2(p.x - fan_origin.x, p.z - fan_origin.z); }
double elevation_of(const Vec3& p) {
    const Vec3 d = p - fan_origin;
    return std::atan2(d.y, std::hypot(d.x, d.z));
}
/// The skin's place straight in front at (x, y).
Vec3 front_point(const Vec2& xy) { return leave_head({xy.x, xy.y, 30}, {0, 0, 1}); }

/// Knots of a grid's axis: value at each line, lines spread evenly between knots or growing by a constant ratio.
struct Axis {
    std::vector<double> lines;
    explicit Axis(double first) : lines{first} {}
    int add_even(double to, int steps) {
        const double from = lines.back();
        for (int k = 1; k <= steps; ++k) lines.push_back(mix(from, to, static_cast<double>(k) / steps));
        return static_cast<int>(lines.size()) - 1;
    }
    /// Steps begin as wide as the last one and grow or shrink in geometric progression to end at `to`.
    int add_graded(double to, int steps) {
        const double from = lines.back(), length = to - from;
        const double first = std::abs(lines.back() - lines[lines.size() - 2]) / std::abs(length);
        double low = 0.5, high = 2;  // the ratio for which the steps add up to the length
        for (int k = 0; k < 60; ++k) {
            const double ratio = (low + high) / 2;
            double sum = 0, step = first;
            for (int n = 0; n < steps; ++n, step *= ratio) sum += step;
            (sum < 1 ? low : high) = ratio;
        }
        double sum = 0, step = first;
        for (int n = 0; n < steps - 1; ++n, step *= low) lines.push_back(from + length * (sum += step));
        lines.push_back(to);
        return static_cast<int>(lines.size()) - 1;
    }
};

struct Grid {
    Axis azimuth{0}, elevation{0};
    int mouth_corner = 0, inner_canthus = 0, outer_canthus = 0;  // columns
    int chin = 0, mouth = 0, eye = 0, brow = 0;                  // rows
    int last_column() const { return static_cast<int>(azimuth.lines.size()) - 1; }
    int last_row() const { return static_cast<int>(elevation.lines.size()) - 1; }
};

Grid make_grid(double fineness) {
    const auto steps = [&](double count) { return std::max(3, static_cast<int>(std::lround(count * fineness))); };
    const double inner = azimuth_of(front_point(landmark::inner_canthus));
    const double outer = azimuth_of(front_point(landmark::outer_canthus));
    const double corner = azimuth_of(front_point({mouth_corner_x, lip_line_y(mouth_corner_x)}));
    Grid grid;
    grid.inner_canthus = grid.azimuth.add_even(inner, steps(15));
    grid.mouth_corner = grid.azimuth.add_even(corner, std::max(2, steps(22 * (corner - inner) / (outer - inner))));
    grid.outer_canthus = grid.azimuth.add_even(outer, steps(22 * (outer - corner) / (outer - inner)));
    grid.azimuth.add_graded(radians(180), steps(38));

    const double mouth = elevation_of(front_point({0, stomion_y}));
    const double eye =
        elevation_of(front_point({mix(landmark::inner_canthus.x, landmark::outer_canthus.x, 0.5), canthal_y(32)}));
    // Rows below the chin have no elevation of their own, see below_chin; these only set how the texture is shared out.
    grid.elevation = Axis(radians(-78));
    grid.chin = grid.elevation.add_even(chin_elevation, steps(24));
    grid.mouth = grid.elevation.add_even(mouth, steps(15));
    grid.eye = grid.elevation.add_even(eye, steps(38));
    grid.brow = grid.elevation.add_even(brow_elevation, steps(22));
    grid.elevation.add_graded(radians(90), steps(26));
    return grid;
}

/// Builds the left half, column 0 and the last one on the plane x = 0.
class HalfHead {
public:
    HalfHead(double fineness, Head& head) : grid_(make_grid(fineness)), head_(head) {
        number_vertices();
        place_fan();
        relax();
        place_texture();
        store();
        line_lids();
        line_mouth();
        add_left_ear(head_.mesh, fineness, {0.5 + 0.01, 0.0025}, ear_uv_side);
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
        return seam;
    }
    /// The copies of the pole, one a column.
    std::vector<Index> poles() const {
        std::vector<Index> all;
        for (int i = 0; i <= grid_.last_column(); ++i) all.push_back(id(i, grid_.last_row()));
        return all;
    }

private:
    bool in_mouth(int i) const { return i < grid_.mouth_corner; }
    bool in_eye(int i) const { return i > grid_.inner_canthus && i < grid_.outer_canthus; }
    bool slit(int i, int j) const { return (j == grid_.mouth && in_mouth(i)) || (j == grid_.eye && in_eye(i)); }
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
                upper_[cell] = slit(i, j) ? next++ : lower_[cell];
            }
        }
        positions_.resize(next);
        uv_.resize(next);
        pinned_.resize(next, 0);
    }

    /// Where column i meets the height y(x): the edge of a slit.
    template <class Height>
    Vec3 on_curve(int i, double elevation, Height y) const {
        Vec3 p{};
        for (int k = 0; k < 25; ++k) {
            p = leave_head(fan_origin, direction(grid_.azimuth.lines[static_cast<std::size_t>(i)], elevation));
            elevation += 0.8 * (y(p.x) - p.y) / glm::length(p - fan_origin);
        }
        return p;
    }

    /// Below the chin the fan's origin sinks into the neck while its rays level out: share 0 at the chin, 1 at the end.
    Vec3 below_chin(int i, double share) const {
        const Vec3 origin = fan_origin + (neck_end_centre - fan_origin) * share;
        const double elevation = mix(chin_elevation, 0, share);
        return leave_head(origin, direction(grid_.azimuth.lines[static_cast<std::size_t>(i)], elevation));
    }

    /// How much of a slit's bend is left `rows` rows away.
    static double bend(double rows, double reach) { return square(std::max(0.0, 1 - square(rows / reach))); }

    void place_fan() {
        const double eye_reach = 0.62 * (grid_.brow - grid_.eye), mouth_reach = 0.8 * (grid_.mouth - grid_.chin);
        for (int i = 0; i <= grid_.last_column(); ++i) {
            const double azimuth = grid_.azimuth.lines[static_cast<std::size_t>(i)];

            const auto level = [&](int j) { return grid_.elevation.lines[static_cast<std::size_t>(j)]; };

            Vec3 eye_up{}, eye_low{}, lip{};
            double up_bend = 0, low_bend = 0, lip_bend = 0;
            if (i >= grid_.inner_canthus && i <= grid_.outer_canthus) {
                const bool open = in_eye(i);
                eye_up = on_curve(i, level(grid_.eye),
                                  [&](double x) { return canthal_y(x) + (open ? upper_lid_height(x) : 0); });
                eye_low = on_curve(i, level(grid_.eye),
                                   [&](double x) { return canthal_y(x) - (open ? lower_lid_height(x) : 0); });
                up_bend = elevation_of(eye_up) - level(grid_.eye);
                low_bend = elevation_of(eye_low) - level(grid_.eye);
            }
            if (i <= grid_.mouth_corner) {
                lip = on_curve(i, level(grid_.mouth), [](double x) { return lip_line_y(x); });
                lip_bend = elevation_of(lip) - level(grid_.mouth);
            }
            for (int j = 0; j < grid_.last_row(); ++j) {
                double elevation = level(j);

                elevation += bend(j - grid_.eye, eye_reach) * (j < grid_.eye ? low_bend : up_bend);
                elevation += bend(j - grid_.mouth, mouth_reach) * lip_bend;
                positions_[id(i, j)] = j < grid_.chin ? below_chin(i, 1 - static_cast<double>(j) / grid_.chin)
                                                      : leave_head(fan_origin, direction(azimuth, elevation));
            }

            pinned_[id(i, 0)] = 1;
            if (i >= grid_.inner_canthus && i <= grid_.outer_canthus) {
                pin(i, grid_.eye, eye_low, eye_up);
            }
            if (i <= grid_.mouth_corner) pin(i, grid_.mouth, lip, lip);
        }
        const Vec3 pole = leave_head(fan_origin, {0, 1, 0});
        for (int i = 0; i <= grid_.last_column(); ++i) positions_[id(i, grid_.last_row())] = {0, pole.y, pole.z};
        for (int j = 0; j <= grid_.last_row(); ++j) {
            for (const int i : {0, grid_.last_column()}) positions_[id(i, j)].x = positions_[upper_id(i, j)].x = 0;
        }
    }

    void pin(int i, int j, const Vec3& low, const Vec3& up) {
        positions_[id(i, j)] = low;
        positions_[upper_id(i, j)] = up;
        pinned_[id(i, j)] = pinned_[upper_id(i, j)] = 1;
    }

    /// Slides every free vertex toward the mean of its neighbours, weighted so that the grid's own grading is kept, and
    /// back onto the surface: this spreads rows over places that the fan sees edge-on (under the nose and the chin).
    void relax() {
        constexpr int rounds = 24;
        const auto weight = [](const std::vector<double>& lines, int k) {
            const auto n = static_cast<std::size_t>(k);
            const double before = lines[n] - lines[n - 1], after = lines[n + 1] - lines[n];
            return after / (before + after);
        };
        std::vector<Vec3> next = positions_;
        for (int round = 0; round < rounds; ++round) {
            parallel_pieces(grid_.last_row() - 1, [&](int first, int last) {
                for (int j = first + 1; j <= last; ++j) {
                    for (int i = 0; i <= grid_.last_column(); ++i) {
                        const Index v = id(i, j);
                        if (pinned_[v]) continue;
                        const Vec3 right = i > 0 ? positions_[id(i - 1, j)] : mirrored(positions_[id(1, j)]);
                        const Vec3 left =
                            i < grid_.last_column() ? positions_[id(i + 1, j)] : mirrored(positions_[id(i - 1, j)]);
                        const double toward_right =
                            i > 0 && i < grid_.last_column() ? weight(grid_.azimuth.lines, i) : 0.5;
                        const Vec3 below = positions_[upper_id(i, j - 1)], above = positions_[id(i, j + 1)];
                        const double toward_below = weight(grid_.elevation.lines, j);
                        const Vec3 mean = (right * toward_right + left * (1 - toward_right) + below * toward_below +
                                           above * (1 - toward_below)) /
                                          2.0;
                        Vec3 p = project_to_head(blend(positions_[v], mean, 0.6));
                        if (i == 0 || i == grid_.last_column()) p.x = 0;
                        next[v] = p;
                    }
                }
            });
            positions_.swap(next);
        }
    }

    /// u follows the columns and v the rows, the back half of the head at half density. Slits gape a little in the
    /// texture so that the linings have room there.
    void place_texture() {
        const auto spread = [](const std::vector<double>& lines, double from, double density_before, double to,
                               double density_after) {
            std::vector<double> place{0};
            for (std::size_t k = 1; k < lines.size(); ++k) {
                const double middle = (lines[k] + lines[k - 1]) / 2;
                const double density = middle < from ? density_before : middle > to ? density_after : 1;
                place.push_back(place.back() + density * (lines[k] - lines[k - 1]));
            }
            for (double& x : place) x /= place.back();
            return place;
        };
        const auto u = spread(grid_.azimuth.lines, -1, 1, radians(75), 0.4);
        const auto v = spread(grid_.elevation.lines, chin_elevation, 2.0, radians(50), 0.6);
        const double eye_reach = 0.62 * (grid_.brow - grid_.eye), mouth_reach = 0.8 * (grid_.mouth - grid_.chin);
        for (int j = 0; j <= grid_.last_row(); ++j) {
            for (int i = 0; i <= grid_.last_column(); ++i) {
                const auto column = static_cast<std::size_t>(i), row = static_cast<std::size_t>(j);
                const double gape = eye_gape(i) * bend(j - grid_.eye, eye_reach),
                             lip_gape = mouth_gape(i) * bend(j - grid_.mouth, mouth_reach);
                const auto at = [&](int side_eye, int side_mouth) {
                    const double height = v[row] + side_eye * gape + side_mouth * lip_gape;
                    return Vec2(0.5 + 0.5 * u[column], 1 - height * (1 - face_v_top));
                };
                const int eye_side = j > grid_.eye ? 1 : -1, mouth_side = j > grid_.mouth ? 1 : -1;
                uv_[upper_id(i, j)] = at(j == grid_.eye ? 1 : eye_side, j == grid_.mouth ? 1 : mouth_side);
                uv_[id(i, j)] = slit(i, j) ? at(eye_side, mouth_side) : uv_[upper_id(i, j)];
                if (j == grid_.eye && !in_eye(i)) uv_[id(i, j)] = at(0, mouth_side);
                if (j == grid_.mouth && !in_mouth(i)) uv_[id(i, j)] = at(eye_side, 0);
            }
        }
        mouth_v_ = v[static_cast<std::size_t>(grid_.mouth)];
        eye_v_ = v[static_cast<std::size_t>(grid_.eye)];
    }
    /// Half of the slit's opening in the texture, as a fraction of the face's height there.
    double eye_gape(int i) const {
        if (!in_eye(i)) return 0;
        const double t = static_cast<double>(i - grid_.inner_canthus) / (grid_.outer_canthus - grid_.inner_canthus);
        return 0.016 * std::sqrt(std::sin(pi * t));
    }
    double mouth_gape(int i) const {
        if (!in_mouth(i)) return 0;
        const double t = static_cast<double>(i) / grid_.mouth_corner;
        return 0.02 * std::sqrt(1 - t * t);
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
                    tag.lip = j > grid_.mouth ? 1 : j < grid_.mouth ? -1 : !in_mouth(i) ? 0 : is_upper_copy ? 1 : -1;
                    tag.lid = j > grid_.eye ? 1 : j < grid_.eye ? -1 : !in_eye(i) ? 0 : is_upper_copy ? 1 : -1;
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

    /// Adds rings inward from an upper and a lower edge; `place(k, side, ring)` gives a vertex, the two sides share
    /// their vertices where `shared(k, ring)`.
    template <class Place, class Texture, class Shared>
    void add_lining(const std::vector<Index>& upper, const std::vector<Index>& lower, int rings, Part part, Place place,
                    Texture texture, Shared shared) {
        const std::size_t n = upper.size();
        std::vector<Index> previous_upper = upper, previous_lower = lower;
        for (int ring = 1; ring <= rings; ++ring) {
            std::vector<Index> next_upper(n), next_lower(n);
            for (std::size_t k = 0; k < n; ++k) {
                const auto add = [&](int side, Index edge) {
                    VertexTag tag;
                    tag.part = part;
                    tag.depth = static_cast<double>(ring) / rings;
                    tag.edge = edge;
                    (part == Part::lid_lining ? tag.lid : tag.lip) = side;
                    if (part == Part::lid_lining) tag.lip = 1;
                    head_.tags.push_back(tag);
                    return head_.mesh.add(place(k, side, ring), texture(k, side, ring));
                };
                const bool one = shared(k, ring);
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
        constexpr int rings = 4;
        constexpr double sealed_inside =
            -1.0;  // the last ring lies in the eyeball, so that no gap shows behind the lids

        constexpr double clearance[rings + 1] = {0, 1.25, 0.45, 0.6, sealed_inside};  // millimetres over the eyeball
        constexpr double turn_degrees[rings + 1] = {0, 0.0, 1.0, 9, 26};              // away from the opening
        const std::size_t last = head_.upper_lid.size() - 1;
        const auto place = [&](std::size_t k, int side, int ring) {
            const Vec3 arm = head_.mesh.positions[side >= 0 ? head_.upper_lid[k] : head_.lower_lid[k]] - eye_centre;
            const double reach = glm::length(arm);
            if (side == 0) {  // the corners go straight back along the ball
                const Vec3 back = arm - Vec3(0, 0, 0.5 * ring);
                const double length =
                    ring == rings ? eye_radius + sealed_inside : std::max(glm::length(back), eye_radius + 0.4);
                return eye_centre + back * (length / glm::length(back));
            }
            const double radius = std::min(reach, eye_radius + clearance[ring]);
            const double turn = radians(turn_degrees[ring]) * side;
            // A lid turns about the horizontal axis through the eye's centre.
            const Vec3 turned(arm.x, arm.y * std::cos(turn) + arm.z * std::sin(turn),
                              arm.z * std::cos(turn) - arm.y * std::sin(turn));
            return eye_centre + turned * (radius / reach);
        };
        const auto texture = [&](std::size_t k, int side, int ring) {
            const Index edge = side >= 0 ? head_.upper_lid[k] : head_.lower_lid[k];
            const double middle = 1 - eye_v_ * (1 - face_v_top);
            return Vec2(head_.mesh.uv[edge].x, mix(head_.mesh.uv[edge].y, middle, 0.9 * ring / rings));
        };
        add_lining(head_.upper_lid, head_.lower_lid, rings, Part::lid_lining, place, texture,
                   [&](std::size_t k, int) { return k == 0 || k == last; });
    }

    /// The lips turn in, line the vestibule in front of the teeth and close behind them as palate and floor.
    void line_mouth() {
        constexpr int rings = 9;
        const std::size_t last = head_.upper_lip.size() - 1;
        const auto place = [&](std::size_t k, int side, int ring) {
            const Vec3 edge = head_.mesh.positions[head_.upper_lip[k]];
            const double t = static_cast<double>(k) / static_cast<double>(last);
            const double open = std::sqrt(std::max(0.0, 1 - std::pow(t, 4)));  // the sides meet behind the corner
            const double angle = t * pi / 2;
            // Seen from above, the vestibule is half an ellipse outside the dental arch.
            const auto arch = [&](double half_width, double front) {
                return Vec3(half_width * std::sin(angle), edge.y, 46 + (front - 46) * std::cos(angle));
            };
            const auto raised = [&](const Vec3& p, double height) { return p + Vec3(0, side * height * open, 0); };
            const Vec3 wall = arch(35, 87.2);
            switch (ring) {
                case 1:
                    return raised(edge + Vec3(0, 0, -1.6), 0.25);
                case 2:
                    return raised(blend(edge + Vec3(0, 0, -3.4), wall, 0.12), 1.2);
                case 3:
                    return raised(blend(edge + Vec3(0, 0, -4.6), wall, 0.4), 4);
                case 4:
                    return raised(wall, 8.5);
                case 5:
                    return raised(wall + Vec3(0, 0, 0.4), 13);
                case 6:
                    return raised(arch(33, 84), 16.5);
                case 7:
                    return raised(arch(26, 76), 18);
                case 8:
                    return raised(arch(15, 64), 17);
                default:
                    return arch(4, 40);
            }
        };
        const auto texture = [&](std::size_t k, int side, int ring) {
            const Index edge = side >= 0 ? head_.upper_lip[k] : head_.lower_lip[k];
            const double middle = 1 - mouth_v_ * (1 - face_v_top);
            // Inward the texture shrinks from the lips' corners too: nothing of the skin around bleeds into the throat.
            const double inward = static_cast<double>(ring) / rings;
            return Vec2(mix(head_.mesh.uv[edge].x, 0.5, 0.5 * inward), mix(head_.mesh.uv[edge].y, middle, inward));
        };
        const std::size_t half = head_.mesh.positions.size();
        add_lining(head_.upper_lip, head_.lower_lip, rings, Part::mouth_lining, place, texture,
                   [&](std::size_t k, int ring) { return k == last || ring == rings; });
        for (std::size_t v = half; v < head_.mesh.positions.size(); ++v)
            if (std::abs(head_.mesh.positions[v].x) < 1e-9) head_.mesh.positions[v].x = 0;
    }
    static Vec3 blend(const Vec3& a, const Vec3& b, double t) { return a + (b - a) * t; }

    Grid grid_;
    Head& head_;
    std::size_t columns_ = 0;
    std::vector<Index> lower_, upper_;
    std::vector<Vec3> positions_;
    std::vector<Vec2> uv_;
    std::vector<char> pinned_;
    double mouth_v_ = 0, eye_v_ = 0;
};

}  // namespace

Head make_head(std::size_t vertices) {
    constexpr double vertices_at_fineness_1 = 25'000;  // counted; both halves, ears and linings
    const double fineness =
        std::sqrt(static_cast<double>(std::clamp<std::size_t>(vertices, 6'000, 30'000)) / vertices_at_fineness_1);
    Head head;
    const HalfHead half(fineness, head);
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
    head.mesh.normals = head_normals(head, head.mesh.positions);
    return head;
}

std::vector<Vec3> head_normals(const Head& head, std::span<const Vec3> positions) {
    return smooth_normals(positions, head.mesh.triangles, head.weld);
}

}  // namespace blush::make_face
