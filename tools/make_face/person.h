#pragma once
/// A person: values of the shape parameters and the colours of skin, hair and eyes, as a preset file holds them.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "rig/result.h"
#include "tools/make_face/parameters.h"

namespace blush::make_face {

/// What colours a person. Concentrations and the blend of the two melanins are those of jimenez-2012, 7.6.
struct SkinTone {
    double melanin = 0.021;                           ///< fraction of the epidermis, 0 to 0.5
    double melanin_blend = 0.61;                      ///< share of eumelanin in it, 0 to 1; the rest is pheomelanin
    double hemoglobin = 0.015;                        ///< fraction of the dermis that is blood, 0 to 0.3
    std::array<double, 3> hair{0.29, 0.20, 0.135};    ///< sRGB, 0 to 1
    std::array<double, 3> eyes{0.345, 0.388, 0.365};  ///< the iris, sRGB, 0 to 1
    double freckles = 0.25;                           ///< 0 none to 1 many
};

struct Person {
    std::string name = "default";
    std::vector<double> shape;  ///< one value for each of parameters(), in their units
    SkinTone skin;

    Person();
};

/// Reads {"blush_person": 1, "name": ..., "shape": {PARAMETER: VALUE}, "skin": {...}}; what is left out is as in the
/// default person. Error: what is wrong and where, an unknown name with the nearest one, a value out of its range.
Result<Person> read_person(std::string_view json, const std::string& file);

/// "jaw_width=+1". Error: no such parameter, no number, out of range.
Status set_parameter(Person& person, std::string_view assignment);

}  // namespace blush::make_face
