#include "tools/make_face/mouth_parts.h"

#include "tools/make_face/head_shape.h"

namespace blush::make_face {
namespace {

/// The arch seen from above: half an ellipse; the lower one is a little smaller, so that the upper teeth overlap it.
struct Arch {
    double half_width, front_z, root_y, edge_y, thickness;
    double upward;  ///< +1: roots above the edges
    std::array<double, 7> tooth_widths;
};

/// Mesiodistal crown widths from the midline outward, mm: Wheeler's Dental Anatomy (Ash and Nelson 2003), table 1-1.
constexpr Arch upper_arch{27.5, 84.6, -59.5, -71.0, 6.5, 1, {8.5, 6.5, 7.5, 7.0, 7.0, 10.0, 9.0}};
constexpr Arch lower_arch{25.5, 82.0, -78.6, -69.6, 6.0, -1, {5.0, 5.5, 7.0, 7.0, 7.0, 11.0, 10.5}};
constexpr double arch_rear_z = 42;

const Arch& arch_of(Jaw jaw) { return jaw == Jaw::upper ? upper_arch : lower_arch; }

/// Place on the arch and outward direction at a length of `along` millimetres from the midline.
struct ArchPoint {
    Vec3 place, outward;
};
ArchPoint arch_point(const Arch& arch, double along) {
    const double depth = arch.front_z - arch_rear_z;
    constexpr double step = 0.002;
    double angle = 0, length = 0;
    while (length < along && angle < 1.75) {
        length += step * std::hypot(arch.half_width * std::cos(angle), depth * std::sin(angle));
        angle += step;
    }
    const Vec3 place(arch.half_width * std::sin(angle), 0, arch_rear_z + depth * std::cos(angle));
    return {place, glm::normalize(Vec3(std::sin(angle) / arch.half_width, 0, std::cos(angle) / depth))};
}

/// Sweeps a cross-section along the left half of the arch and mirrors it. `section(along, k)` gives outward and y
/// offsets.
template <class Section>
Mesh sweep(const Arch& arch, const std::vector<double>& stations, int around, Section section) {
    Mesh mesh;
    for (const double along : stations) {
        const ArchPoint point = arch_point(arch, along);
        for (int k = 0; k <= around; ++k) {
            const Vec2 offset = section(along, k);
            Vec3 p = point.place + point.outward * offset.x;
            p.y = offset.y;
            if (along == 0) p.x = 0;
            mesh.add(p, {0.5 + 0.5 * along / stations.back(), static_cast<double>(k) / around});
        }
    }
    const auto ring = static_cast<Index>(around + 1);
    for (Index s = 0; s + 1 < stations.size(); ++s) {
        for (Index k = 0; k + 1 < ring; ++k) {
            const Index a = s * ring + k, b = a + ring;
            if (arch.upward > 0)
                mesh.add_quad(a, a + 1, b + 1, b);
            else
                mesh.add_quad(a, b, b + 1, a + 1);
        }
    }
    mirror_across_x(mesh);
    mesh.normals = smooth_normals(mesh);
    return mesh;
}

double total_width(const Arch& arch) {
    double sum = 0;
    for (const double width : arch.tooth_widths) sum += width;
    return sum;
}

}  // namespace

Mesh make_teeth(Jaw jaw) {
    const Arch& arch = arch_of(jaw);
    constexpr int columns = 8, around = 14;
    std::vector<double> stations{0};
    for (const double width : arch.tooth_widths) {
        const double start = stations.back();
        for (int k = 1; k <= columns; ++k) stations.push_back(start + width * k / columns);
    }
    return sweep(arch, stations, around, [&](double along, int k) {
        double start = 0;
        std::size_t tooth = 0;
        while (tooth + 1 < arch.tooth_widths.size() && along > start + arch.tooth_widths[tooth] + 1e-9)
            start += arch.tooth_widths[tooth++];
        const double f = std::clamp((along - start) / arch.tooth_widths[tooth], 0.0, 1.0);
        const double side = std::pow(std::abs(2 * f - 1), 5);  // 1 between two teeth
        const bool molar = tooth >= 3, canine = tooth == 2;
        const double thickness = (molar ? 1.35 : 1.0) * arch.thickness;
        const double shorter = tooth == 1 ? 0.9 : molar ? 1.2 : 0.2;
        const double point = canine ? 1.1 * (0.5 - std::abs(f - 0.5)) - 0.3 : 0;
        const double edge = arch.edge_y + arch.upward * (shorter + 0.9 * side - point);
        // k runs from the gum in front over the edge to the gum behind.
        const double turn = pi * k / around;
        const double height = std::pow(std::sin(turn), molar ? 0.45 : 0.65);  // 0 at the gums, 1 at the edge
        const double taper = molar ? 1 - 0.25 * height : 1 - 0.72 * height;   // an incisor is a wedge
        const double bulge = 0.5 * std::sin(pi * std::min(1.0, height * 1.05)) * (1 - side);
        const double outward = -thickness / 2 + std::cos(turn) * thickness / 2 * taper +
                               bulge * (k < around / 2 ? 1.0 : -0.4) - (k < around / 2 ? 0.9 : -0.9) * side -
                               (molar ? 0 : 0.9 * height);
        return Vec2(outward, mix(arch.root_y, edge, height));
    });
}

namespace {
/// Where the ray from the arch's middle through p meets its ellipse, as a factor on p's way; 1 and less outside.
double way_to_front(const Arch& arch, const Vec3& p, double clearance_mm) {
    // Beyond the teeth's roots gum and bone draw back by half of what they go on: make_gum().
    const double room = clearance_mm - std::max(0.0, 0.5 * (p.y - arch.root_y) * arch.upward);
    const Vec2 radii(arch.half_width + room, arch.front_z - arch_rear_z + room);
    const double reach = glm::length(Vec2(p.x, p.z - arch_rear_z) / radii);
    const double gum_end = arch.root_y + arch.upward * 6;
    const bool level = (p.y - arch.edge_y) * arch.upward > 0 && (gum_end - p.y) * arch.upward > 0;
    return level && p.z > arch_rear_z && reach > 0.3 ? std::max(1.0, 1 / reach) : 1;
}
}  // namespace

double depth_in_teeth(Jaw jaw, const Vec3& p, double clearance_mm) {
    return glm::distance(p, before_teeth(jaw, p, clearance_mm));
}

Vec3 before_teeth(Jaw jaw, const Vec3& p, double clearance_mm) {
    const double factor = way_to_front(arch_of(jaw), p, clearance_mm);
    return {p.x * factor, p.y, arch_rear_z + (p.z - arch_rear_z) * factor};
}

Mesh make_gum(Jaw jaw) {
    const Arch& arch = arch_of(jaw);
    constexpr int around = 16;
    const double end = total_width(arch) + 2;
    std::vector<double> stations;
    for (int s = 0; s <= 84; ++s) stations.push_back(end * s / 84);
    return sweep(arch, stations, around, [&](double along, int k) {
        double start = 0;
        std::size_t tooth = 0;
        while (tooth + 1 < arch.tooth_widths.size() && along > start + arch.tooth_widths[tooth])
            start += arch.tooth_widths[tooth++];
        const double f = std::clamp((along - start) / arch.tooth_widths[tooth], 0.0, 1.0);
        // The margin of the gum is scalloped: it rises between two teeth as a papilla.
        const double papilla = 1.6 * std::pow(std::abs(2 * f - 1), 2.5);
        const double margin = arch.root_y - arch.upward * (0.8 + papilla);
        const double turn = pi * k / around;
        const double reach = std::sin(turn);
        // Away from the teeth the jaw's bone lies farther back, under the fold of lip and chin.
        const double back = std::cos(turn) > 0 ? 5 * (1 - std::pow(reach, 0.4)) : 0;
        const double outward = -arch.thickness / 2 + std::cos(turn) * (arch.thickness / 2 * 1.3 + 0.5) - 0.35 - back;
        return Vec2(outward, mix(arch.root_y + arch.upward * 9, margin, std::pow(reach, 0.4)));
    });
}

Mesh make_tongue() {
    constexpr int along = 26, around = 28;
    Mesh mesh;
    const auto place = [&](double s, double turn) {
        // s = 0 at the root, 1 at the tip; the body thins and rounds off toward the tip.
        const double z = mix(34, 77, s);
        const double round = std::sqrt(std::max(0.0, 1 - std::pow(s, 6)));
        const double half_width = 18 * mix(0.9, 0.78, s) * round, half_height = mix(10, 4.2, s) * round;
        const double middle = mix(-75, -73, s) + 3.5 * std::sin(pi * s);
        const double x = half_width * std::cos(turn);
        const double groove =
            1.3 * bell(x, 3.5) * smooth_step(0, 0.6, std::sin(turn)) * round * smooth_step(1, 0.75, s);
        return Vec3(x, middle + half_height * std::sin(turn) - groove, z);
    };
    for (int n = 0; n <= along; ++n) {
        const double s = std::sin(pi / 2 * n / along);
        for (int k = 0; k < around; ++k) {
            const double turn = 2 * pi * k / around;
            mesh.add(place(s, turn), {static_cast<double>(k) / around, s});
        }
    }
    for (int n = 0; n < along; ++n) {
        for (int k = 0; k < around; ++k) {
            const auto at = [&](int row, int j) { return static_cast<Index>(row * around + j % around); };
            mesh.add_quad(at(n, k), at(n, k + 1), at(n + 1, k + 1), at(n + 1, k));
        }
    }
    mesh.normals = smooth_normals(mesh);
    return mesh;
}

Vec3 tongue_out(const Vec3& p) {
    const double s = std::clamp((p.z - 34) / 43, 0.0, 1.0);
    // The tip clears the lower teeth and lip, then hangs.
    return {0, 3.5 * std::sin(pi * std::min(1.0, 1.1 * s)) - 7 * std::pow(s, 4), 34 * s * s};
}

}  // namespace blush::make_face
