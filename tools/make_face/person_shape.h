#pragma once
/// The map from the default face's space to a person's, and its application to a finished face.
///
/// A displacement field that is mirror symmetric and smooth, so that left and right stay mirror images and lids that
/// meet still meet. About each eye the map is a similarity (a move, a turn about the gaze, one scale), so that lids
/// that clear the ball still clear it.

#include "tools/make_face/person.h"
#include "tools/make_face/write_glb.h"

namespace blush::make_face {

class PersonShape {
public:
    explicit PersonShape(const Person& person);

    /// Where a place of the default face goes, millimetres.
    Vec3 operator()(const Vec3& p) const;
    /// Derivatives of it by x, y and z as columns.
    glm::dmat3 jacobian(const Vec3& p) const;
    /// By how much the eyes grow.
    double eye_scale() const { return eye_scale_; }
    bool is_identity() const { return fields_.empty() && eyes_at_rest_; }

private:
    struct Field {
        Displacement displacement;
        double amount;
    };
    Vec3 field_move(const Vec3& p) const;
    Vec3 about_left_eye(const Vec3& p) const;

    std::vector<Field> fields_;
    bool eyes_at_rest_ = true;
    double eye_scale_ = 1, eye_tilt_radians_ = 0;
    Vec3 eye_move_{0};
};

/// Carries a face that was built in the default space over to the person: positions, normals, targets and the eyes'
/// places. What turns with the jaw turns rigidly about the person's own hinge.
void reshape(FaceParts& face, const PersonShape& shape);

}  // namespace blush::make_face
