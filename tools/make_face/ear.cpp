#include "tools/make_face/ear.h"

#include "tools/make_face/head_shape.h"

namespace blush::make_face {
namespace {

/// The outline at `angle` (0 to the front, a right angle up). Farkas 1994: length 62 mm, breadth 35 mm.
Vec2 outline(double angle) {
    const double b = std::sin(angle);
    const double half_length = b > 0 ? 32 : 30;
    const double half_breadth = b > 0 ? 18.5 : mix(18.5, 12.5, smooth_step(0, 0.9, -b));
    return {half_breadth * std::cos(angle), half_length * b};
}

/// Height of the front side over the ear's plane at the fraction s of the outline, angle from -90 to 270 degrees.
double front_height(double s, double angle) {
    const double a = std::cos(angle), b = std::sin(angle);
    const double lobe = smooth_step(-0.5, -0.85, b);
    const double rear = smooth_step(0.35, -0.25, a), up = smooth_step(radians(150), radians(100), angle);
    const double concha = -3.5 * smooth_step(0.58, 0.3, s);
    // Above, the antihelix parts into two crura with the triangular fossa between them.
    const double antihelix =
        4.6 * rear * std::max(bell(s - mix(0.66, 0.76, up), 0.085), up * bell(s - mix(0.66, 0.5, up), 0.09));
    const double helix = 4.6 * bell(s - 0.94, 0.065) * mix(0.7, 1, smooth_step(0.95, 0.2, a));
    const double crus = 3.6 * bell(angle - radians(12), 0.3) * smooth_step(0.2, 0.55, s) * smooth_step(1, 0.7, s);
    const double tragus = 6.0 * bell(s - 0.62, 0.17) * bell(angle + radians(24), 0.32);
    const double antitragus = 3.4 * bell(s - 0.62, 0.11) * bell(angle - radians(285), 0.4) +
                              3.4 * bell(s - 0.62, 0.11) * bell(angle + radians(75), 0.4);
    const double folds = 1 + concha + antihelix + helix + crus + tragus + antitragus - 3 * bell(s, 0.16);
    const double plain = 1.2 + 2.2 * bell(s - 0.78, 0.3);
    // In front the rim dives into the cheek; only the helix's root and the tragus stay out.
    const double sunk = 11 * smooth_step(mix(0.25, 0.15, lobe), 0.85, a) * smooth_step(0.62, 1, s) *
                        mix(1, 0.35, smooth_step(-0.7, -0.97, b));
    const double toward_neck = 4 * s * smooth_step(-0.5, -1, b);  // the lobe
    return mix(folds, s < 0.55 ? folds : plain, lobe) - sunk - toward_neck;
}

}  // namespace

void add_left_ear(Mesh& mesh, double fineness, const Vec2& uv_corner, double uv_side) {
    const int angles = static_cast<int>(std::lround(54 * fineness));
    const int front_rings = static_cast<int>(std::lround(22 * fineness));
    const int back_rings = static_cast<int>(std::lround(7 * fineness));

    // The plane leans: its rear stands off the head by 20 degrees and its top leans back by 14.

    const double stand = radians(20), lean = radians(14);
    const Vec3 forward(-std::sin(stand), 0, std::cos(stand)), out(std::cos(stand), 0, std::sin(stand));
    const Vec3 along = forward * std::cos(lean) + Vec3(0, 1, 0) * std::sin(lean);
    const Vec3 up = Vec3(0, 1, 0) * std::cos(lean) - forward * std::sin(lean);
    // a to the front of the face, b up, c away from the head, millimetres.
    const auto place = [&](double a, double b, double c) {
        return landmark::ear_centre + along * a + up * b + out * c;
    };
    const auto texture = [&](double s, double angle) {
        return uv_corner + uv_side * (Vec2(0.5) + 0.5 * s * Vec2(std::cos(angle), -std::sin(angle)));
    };

    const double uv_reach = 1.45;  // front rings take s in 0..1, the back goes on to this
    const Index centre = mesh.add(place(0, 0, front_height(0, 0)), texture(0, 0));
    const auto ring_start = [&](int ring) { return centre + 1 + static_cast<Index>((ring - 1) * angles); };
    for (int ring = 1; ring <= front_rings + back_rings; ++ring) {
        for (int k = 0; k < angles; ++k) {
            const double angle = 2 * pi * k / angles - pi / 2;
            const Vec2 r = outline(angle);
            // The canal sits in front of the middle, so rings start off-centre and grow concentric with the outline.
            if (ring <= front_rings) {
                const double s = std::pow(static_cast<double>(ring) / front_rings, 0.8);
                const double shift = 5.0 * (1 - s * s);
                mesh.add(place(s * r.x + shift, s * r.y - 0.4 * shift, front_height(s, angle)),
                         texture(s / uv_reach, angle));
            } else {
                const double t = static_cast<double>(ring - front_rings) / back_rings;
                const double s = 1 + 0.035 * std::sin(pi * std::min(1.0, t * 2.2)) - 0.55 * t * t;
                const double edge = front_height(1, angle);
                mesh.add(place(s * r.x * mix(1, 0.9, t), s * r.y, edge - 3.2 * std::pow(t, 0.6) - 12 * t * t * t),
                         texture((1 + (uv_reach - 1) * t) / uv_reach, angle));
            }
        }
    }
    for (int k = 0; k < angles; ++k) {
        const auto at = [&](int ring, int j) { return ring_start(ring) + static_cast<Index>(j % angles); };
        mesh.triangles.push_back({centre, at(1, k + 1), at(1, k)});
        for (int ring = 1; ring < front_rings + back_rings; ++ring)
            mesh.add_quad(at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k));
    }
}

}  // namespace blush::make_face
