#include "tools/make_face/coarse_head.h"

#include "tools/make_face/flatten.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

using namespace landmark;

// The bust ends in the level plane through chest_origin.
constexpr Vec3 neck_origin{0, -128, -34}, chest_origin{0, -214, -58};
constexpr double neck_share = 0.36, shoulder_share = 0.62;  // of the rows from the chin to the cut
constexpr double shoulder_elevation = radians(44), nape_elevation = radians(-22);
constexpr double chin_elevation = radians(-49), brow_elevation = radians(28);

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

/// How much of a slit's bend is left `rows` rows away.
double bend(double rows, double reach) { return square(std::max(0.0, 1 - square(rows / reach))); }

}  // namespace

Grid make_grid(double fineness) {
    const auto steps = [&](double count) { return std::max(3, static_cast<int>(std::lround(count * fineness))); };
    const double inner = azimuth_of(front_point(landmark::inner_canthus));
    const double outer = azimuth_of(front_point(landmark::outer_canthus));
    const double corner = azimuth_of(front_point({mouth_corner_x, lip_line_y(mouth_corner_x)}));
    Grid grid;
    Axis azimuth(0), elevation(radians(-78));
    grid.inner_canthus = azimuth.add_even(inner, steps(15));
    grid.mouth_corner = azimuth.add_even(corner, std::max(2, steps(22 * (corner - inner) / (outer - inner))));
    grid.outer_canthus = azimuth.add_even(outer, steps(22 * (outer - corner) / (outer - inner)));
    azimuth.add_graded(radians(180), steps(38));

    const double mouth = elevation_of(front_point({0, stomion_y}));
    const double eye =
        elevation_of(front_point({mix(landmark::inner_canthus.x, landmark::outer_canthus.x, 0.5), canthal_y(32)}));
    // Rows below the chin have no elevation of their own, see below_chin; these only set how the texture is shared out.
    grid.chin = elevation.add_even(chin_elevation, steps(30));
    grid.mouth = elevation.add_even(mouth, steps(15));
    grid.eye = elevation.add_even(eye, steps(38));
    grid.brow = elevation.add_even(brow_elevation, steps(22));
    elevation.add_graded(radians(90), steps(26));
    grid.azimuths = azimuth.lines;
    grid.elevations = elevation.lines;
    return grid;
}

CoarseHead::CoarseHead() : grid_(make_grid(1)) {
    number_vertices();
    place_fan();
    relax();
    lay_flat();
}

Index CoarseHead::id(int i, int j) const {
    return lower_[static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i)];
}
Index CoarseHead::upper_id(int i, int j) const {
    return upper_[static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i)];
}

/// A vertex on a slit exists twice: `lower` belongs to the row below, `upper` to the row above. The last row
/// lies on one pole, a copy for each column: a shared one would stretch the texture of its triangles to a smear.
void CoarseHead::number_vertices() {
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
    flat_.resize(next);
    pinned_.resize(next, 0);
}

/// Where column i meets the height y(x): the edge of a slit.
template <class Height>
Vec3 CoarseHead::on_curve(int i, double elevation, Height y) const {
    Vec3 p{};
    for (int k = 0; k < 25; ++k) {
        p = leave_head(fan_origin, direction(grid_.azimuths[static_cast<std::size_t>(i)], elevation));
        elevation += 0.8 * (y(p.x) - p.y) / glm::length(p - fan_origin);
    }
    return p;
}

/// Below the chin the fan's origin sinks through the neck to the plane of the cut while its rays level out, then rise
/// to meet the shoulders from below and come down into that plane: share 0 at the chin, 1 at the cut.
Vec3 CoarseHead::below_chin(int i, double share) const {
    const double azimuth = grid_.azimuths[static_cast<std::size_t>(i)];
    const double neck = std::min(1.0, share / neck_share);
    const double shoulder = smooth_step(neck_share, shoulder_share, share);
    const double chest = std::max(0.0, (share - shoulder_share) / (1 - shoulder_share));
    const Vec3 origin = glm::mix(glm::mix(fan_origin, neck_origin, neck), chest_origin, shoulder);
    // Rays to the nape stay inclined, so that its rows do not climb back.
    const double level = mix(0, nape_elevation, smooth_step(radians(90), radians(180), azimuth));
    const double elevation = mix(mix(mix(chin_elevation, level, neck), shoulder_elevation, shoulder), 0, chest);
    return leave_head(origin, direction(azimuth, elevation));
}

void CoarseHead::place_fan() {
    const double eye_reach = 0.62 * (grid_.brow - grid_.eye), mouth_reach = 0.8 * (grid_.mouth - grid_.chin);
    for (int i = 0; i <= grid_.last_column(); ++i) {
        const double azimuth = grid_.azimuths[static_cast<std::size_t>(i)];

        const auto level = [&](int j) { return grid_.elevations[static_cast<std::size_t>(j)]; };

        Vec3 eye_up{}, eye_low{}, lip{};
        double up_bend = 0, low_bend = 0, lip_bend = 0;
        if (i >= grid_.inner_canthus && i <= grid_.outer_canthus) {
            const bool open = grid_.in_eye(i);
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

void CoarseHead::pin(int i, int j, const Vec3& low, const Vec3& up) {
    positions_[id(i, j)] = low;
    positions_[upper_id(i, j)] = up;
    pinned_[id(i, j)] = pinned_[upper_id(i, j)] = 1;
}

/// Slides every free vertex toward the mean of its neighbours, weighted so that the grid's own grading is kept, and
/// back onto the surface: this spreads rows over places that the fan sees edge-on (under the nose and the chin).
void CoarseHead::relax() {
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
                    const double toward_right = i > 0 && i < grid_.last_column() ? weight(grid_.azimuths, i) : 0.5;
                    const Vec3 below = positions_[upper_id(i, j - 1)], above = positions_[id(i, j + 1)];
                    const double toward_below = weight(grid_.elevations, j);
                    const Vec3 mean = (right * toward_right + left * (1 - toward_right) + below * toward_below +
                                       above * (1 - toward_below)) /
                                      2.0;
                    // Along the surface only: at the tip of the nose the mean lies deep inside.
                    const Vec3 way = mean - positions_[v], normal = head_normal(positions_[v]);
                    Vec3 p = project_to_head(positions_[v] + 0.6 * (way - normal * glm::dot(way, normal)));
                    if (i == 0 || i == grid_.last_column()) p.x = 0;
                    next[v] = p;
                }
            }
        });
        positions_.swap(next);
    }
}

void CoarseHead::lay_flat() {
    // What hair or clothes hide gets fewer texels a millimetre.
    const auto density = [](const Vec3& p) {
        const double azimuth = azimuth_of(p);
        const double behind = smooth_step(radians(75), radians(125), azimuth);
        const double crown = smooth_step(65, 100, p.y), bust = smooth_step(-120, -165, p.y);
        return 1 - std::max(0.5 * std::max(behind, crown), 0.62 * bust);
    };
    // The lips meet, so the chart is closed there; the crown's copies are one point.
    std::vector<Index> vertex(positions_.size());
    for (Index v = 0; v < vertex.size(); ++v) vertex[v] = v;
    for (int i = 0; i <= grid_.mouth_corner; ++i) vertex[upper_id(i, grid_.mouth)] = id(i, grid_.mouth);
    for (int i = 0; i <= grid_.last_column(); ++i) vertex[id(i, grid_.last_row())] = id(0, grid_.last_row());

    std::vector<Triangle> triangles;
    std::vector<double> scale;
    std::vector<char> fold(positions_.size(), 0);
    const auto add = [&](Index a, Index b, Index c) {
        a = vertex[a], b = vertex[b], c = vertex[c];
        if (a == b || b == c || c == a) return;
        triangles.push_back({a, b, c});
        scale.push_back(density((positions_[a] + positions_[b] + positions_[c]) / 3.0));
    };
    // To begin with, a row lies at its mean height and each of its nodes at its way along it.
    double height = 0;
    for (int j = 0; j <= grid_.last_row(); ++j) {
        double way = 0, rise = 0;
        for (int i = 0; i <= grid_.last_column(); ++i) {
            if (i > 0)
                way += glm::distance(positions_[id(i, j)], positions_[id(i - 1, j)]) * density(positions_[id(i, j)]);
            if (j > 0)
                rise +=
                    glm::distance(positions_[id(i, j)], positions_[upper_id(i, j - 1)]) * density(positions_[id(i, j)]);
            flat_[id(i, j)].x = flat_[upper_id(i, j)].x = way;
            fold[id(i, j)] = fold[upper_id(i, j)] = i == 0;
        }
        height += rise / (grid_.last_column() + 1);
        for (int i = 0; i <= grid_.last_column(); ++i) {
            flat_[id(i, j)].y = height;
            flat_[upper_id(i, j)].y = height + (grid_.slit(i, j) && j == grid_.eye ? 1 : 0);
        }
        if (j == grid_.last_row()) break;
        for (int i = 0; i < grid_.last_column(); ++i) {
            add(upper_id(i, j), upper_id(i + 1, j), id(i + 1, j + 1));
            add(upper_id(i, j), id(i + 1, j + 1), id(i, j + 1));
        }
    }
    // Eyes stay the openings that they are: a lid's edges are held apart by triangles that are no skin.
    for (int i = grid_.inner_canthus; i < grid_.outer_canthus; ++i) {
        add(id(i, grid_.eye), id(i + 1, grid_.eye), upper_id(i + 1, grid_.eye));
        add(id(i, grid_.eye), upper_id(i + 1, grid_.eye), upper_id(i, grid_.eye));
    }
    flat_ = flatten({positions_, triangles, scale, fold}, std::move(flat_));
    for (Index v = 0; v < vertex.size(); ++v) flat_[v] = flat_[vertex[v]];
}

namespace {
/// Catmull and Rom's cubic through b and c.
template <class T>
T cubic(const T& a, const T& b, const T& c, const T& d, double t) {
    return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}
}  // namespace

CoarseHead::Sample CoarseHead::at(double column, double row, bool above) const {
    // Slits cut the grid into three sheets; nothing is interpolated across them.
    const int last = grid_.last_row();
    const auto in_sheet = [&](int end) { return row < end || (row == end && !above); };
    const int first_row = in_sheet(grid_.mouth) ? 0 : in_sheet(grid_.eye) ? grid_.mouth : grid_.eye;
    const int end_row = first_row == 0 ? grid_.mouth : first_row == grid_.mouth ? grid_.eye : last;
    const auto node = [&](int i, int j) {
        const int folded = i < 0 ? -i : i > grid_.last_column() ? 2 * grid_.last_column() - i : i;
        const Index v = j == first_row ? upper_id(folded, j) : id(folded, j);
        if (i < 0) return Sample{mirrored(positions_[v]), Vec2(-flat_[v].x, flat_[v].y)};
        if (i == folded) return Sample{positions_[v], flat_[v]};
        const Index edge = j == first_row ? upper_id(grid_.last_column(), j) : id(grid_.last_column(), j);
        return Sample{mirrored(positions_[v]), 2.0 * flat_[edge] - flat_[v]};
    };
    const int i = std::clamp(static_cast<int>(std::floor(column)), 0, grid_.last_column() - 1);
    const double s = column - i;
    const auto along_row = [&](int j) {
        const Sample a = node(i - 1, j), b = node(i, j), c = node(i + 1, j), d = node(i + 2, j);
        return Sample{cubic(a.position, b.position, c.position, d.position, s),
                      cubic(a.flat, b.flat, c.flat, d.flat, s)};
    };
    const int j = std::clamp(static_cast<int>(std::floor(row)), first_row, end_row - 1);
    const double t = row - j;
    const Sample b = along_row(j), c = along_row(j + 1);
    const auto beyond = [](const Sample& p, const Sample& q) {
        return Sample{2.0 * p.position - q.position, 2.0 * p.flat - q.flat};
    };
    const Sample a = j > first_row ? along_row(j - 1) : beyond(b, c);
    const Sample d = j + 2 <= end_row ? along_row(j + 2) : beyond(c, b);
    return {cubic(a.position, b.position, c.position, d.position, t), cubic(a.flat, b.flat, c.flat, d.flat, t)};
}

}  // namespace blush::make_face
