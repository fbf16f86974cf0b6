#include "tools/make_face/person_shape.h"

#include "tools/make_face/expressions.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

using landmark::eye_centre;

/// The similarity about an eye holds inside the first radius and has faded at the second, mm.
constexpr double eye_hold = 1.35 * landmark::eye_radius, eye_fade = 2.7 * landmark::eye_radius;

double bell_weight(const Displacement& d, const Vec3& p) {
    const Vec3 q = (p - d.centre) / d.widths;
    const double r = glm::dot(q, q);
    constexpr double faded = 12;  // 6e-6 of the peak
    return r > faded ? 0 : std::exp(-r);
}

/// The softened ramp: its slope rises and falls smoothly over the outer quarters.
double ramp_weight(const Displacement& d, const Vec3& p) {
    const double t = std::clamp((glm::dot(d.axis, p) - d.low) / (d.high - d.low), 0.0, 1.0);
    return mix(t, t * t * (3 - 2 * t), 0.7);
}

double eye_weight(const Vec3& p, const Vec3& centre) {
    return smooth_step(eye_fade, eye_hold, glm::distance(p, centre));
}

/// By how much the measure that this parameter is differs from the default face's, in the parameter's own unit of
/// displacement: millimetres where it has figures.
double measure_change(const Parameter& parameter, double value, double sex) {
    const double spread = parameter.unit == "sd" ? parameter.standard_deviation : 1;
    return (value - parameter.at_rest) * spread + sex * (parameter.men - parameter.women) / 2;
}

}  // namespace

PersonShape::PersonShape(const Person& person) {
    const double sex = person.shape[*parameter_index("sex")];
    double outward = 0;
    for (std::size_t k = 0; k < parameters().size(); ++k) {
        const Parameter& parameter = parameters()[k];
        const double change = measure_change(parameter, person.shape[k], sex);
        if (change == 0) continue;
        for (const Displacement& displacement : parameter.moves) fields_.push_back({displacement, change});
        outward += change * parameter.eyes.outward_mm;
        eye_scale_ += change * parameter.eyes.growth;
        eye_tilt_radians_ += radians(change * parameter.eyes.tilt_degrees);
    }
    eyes_at_rest_ = outward == 0 && eye_scale_ == 1 && eye_tilt_radians_ == 0;
    eye_move_ = field_move(eye_centre) + Vec3(outward, 0, 0);
}

Vec3 PersonShape::field_move(const Vec3& p) const {
    Vec3 sum(0);
    for (const Field& field : fields_) {
        const Displacement& d = field.displacement;
        if (d.kind == Displacement::ramp) {
            sum += field.amount * ramp_weight(d, p) * d.move;
            continue;
        }
        sum += field.amount * bell_weight(d, p) * d.move;
        if (d.centre.x != 0) sum += mirrored(field.amount * bell_weight(d, mirrored(p)) * d.move);
    }
    return sum;
}

Vec3 PersonShape::about_left_eye(const Vec3& p) const {
    const Vec3 arm = (p - eye_centre) * eye_scale_;
    const double c = std::cos(eye_tilt_radians_), s = std::sin(eye_tilt_radians_);
    return eye_centre + eye_move_ + Vec3(c * arm.x - s * arm.y, s * arm.x + c * arm.y, arm.z);
}

Vec3 PersonShape::operator()(const Vec3& p) const {
    if (p.x < 0) return mirrored((*this)(mirrored(p)));  // mirror images to the bit
    const double left = eye_weight(p, eye_centre), right = eye_weight(p, mirrored(eye_centre));
    Vec3 moved(0);
    if (left + right < 1) moved += (1 - left - right) * (p + field_move(p));
    if (left > 0) moved += left * about_left_eye(p);
    if (right > 0) moved += right * mirrored(about_left_eye(mirrored(p)));
    if (p.x == 0) moved.x = 0;
    return moved;
}

glm::dmat3 PersonShape::jacobian(const Vec3& p) const {
    constexpr double h = 0.01;  // mm
    glm::dmat3 columns(1);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        Vec3 step(0);
        step[axis] = h;
        columns[axis] = ((*this)(p + step) - (*this)(p - step)) / (2 * h);
    }
    return columns;
}

namespace {

/// A normal goes with the inverse transpose, here as the matrix of cofactors.
Vec3 carried_normal(const glm::dmat3& j, const Vec3& n) {
    return glm::normalize(Vec3(glm::dot(glm::cross(j[1], j[2]), n), glm::dot(glm::cross(j[2], j[0]), n),
                               glm::dot(glm::cross(j[0], j[1]), n)));
}

/// How far the jaw's turn takes p when it took q to q + delta.
double jaw_angle(const Vec3& q, const Vec3& delta) {
    const Vec3 from = q - landmark::jaw_hinge, to = from + delta;
    return std::atan2(from.y * to.z - from.z * to.y, from.y * to.y + from.z * to.z);
}

class Reshaper {
public:
    explicit Reshaper(const PersonShape& shape) : shape_(shape), hinge_(shape(landmark::jaw_hinge)) {}

    void apply(MeshPart& part) const {
        const std::vector<Vec3> rest = part.mesh.positions, normals = part.mesh.normals;
        const auto count = static_cast<int>(rest.size());
        parallel_pieces(count, [&](int first, int last) {
            for (int i = first; i < last; ++i) {
                const auto v = static_cast<std::size_t>(i);
                part.mesh.positions[v] = shape_(rest[v]);
                part.mesh.normals[v] = carried_normal(shape_.jacobian(rest[v]), normals[v]);
            }
        });
        std::vector<Vec3> jaw_open;
        for (const ShapeTarget& target : part.targets)
            if (target.name == "jawOpen") jaw_open = target.position_deltas;
        for (ShapeTarget& target : part.targets) {
            parallel_pieces(count, [&](int first, int last) {
                for (int i = first; i < last; ++i) {
                    const auto v = static_cast<std::size_t>(i);
                    Vec3 &delta = target.position_deltas[v], &turn = target.normal_deltas[v];
                    if (delta == Vec3(0) && turn == Vec3(0)) continue;
                    const Vec3 end = rest[v] + delta;
                    const Vec3 normal = normals[v] + turn;
                    delta = moved(target.name, rest[v], delta, jaw_open.empty() ? Vec3(0) : jaw_open[v],
                                  part.mesh.positions[v]);
                    if (turn != Vec3(0)) turn = carried_normal(shape_.jacobian(end), normal) - part.mesh.normals[v];
                }
            });
        }
    }

private:
    /// `q`, `delta`: in the default space; `p`: where q is on the person.
    Vec3 moved(const std::string& name, const Vec3& q, const Vec3& delta, const Vec3& jaw_delta, const Vec3& p) const {
        if (name == "jawForward" || name == "jawLeft" || name == "jawRight") return delta;  // the jaw glides as a whole
        if (name == "jawOpen") return opened(q, delta, p);
        // mouthClose closes what jawOpen opened: lips that meet in the default space after both must meet here.
        if (name == "mouthClose") return shape_(q + jaw_delta + delta) - p - opened(q, jaw_delta, p);
        return shape_(q + delta) - p;
    }
    Vec3 opened(const Vec3& q, const Vec3& delta, const Vec3& p) const {
        const double angle = jaw_angle(q, delta), c = std::cos(angle), s = std::sin(angle);
        const Vec3 arm = p - hinge_;
        return hinge_ + Vec3(arm.x, c * arm.y - s * arm.z, s * arm.y + c * arm.z) - p;
    }

    const PersonShape& shape_;
    Vec3 hinge_;
};

}  // namespace

void reshape(FaceParts& face, const PersonShape& shape) {
    if (shape.is_identity()) return;
    const Reshaper reshaper(shape);
    for (NodePart& node : face.nodes) {
        if (node.mesh < 0) continue;
        MeshPart& part = face.meshes[static_cast<std::size_t>(node.mesh)];
        if (node.translation_mm == Vec3(0)) {
            reshaper.apply(part);
            continue;
        }
        // An eye: a ball about its own centre.
        node.translation_mm = shape(node.translation_mm);
        for (Vec3& p : part.mesh.positions) p *= shape.eye_scale();
    }
}

}  // namespace blush::make_face
