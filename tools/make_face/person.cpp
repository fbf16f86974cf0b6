#include "tools/make_face/person.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "rig/blood/skin_colour.h"
#include "rig/names.h"
#include "runtime/files/bad_file.h"
#include "runtime/files/json_text.h"

namespace blush::make_face {
namespace {

using load::refuse;

std::string text_of(double x) { return Json(x).dump(); }

Error no_such_parameter(const std::string& place, const std::string& name) {
    std::vector<std::string> names;
    for (const Parameter& p : parameters()) names.emplace_back(p.name);
    const std::optional<std::string> near = nearest_name(name, names);
    return Error{place + ": no parameter \"" + name + "\" of the face" +
                 (near ? " (did you mean \"" + *near + "\"?)" : "")};
}

Status assign(Person& person, const std::string& place, const std::string& name, double value) {
    const std::optional<std::size_t> index = parameter_index(name);
    if (!index) return no_such_parameter(place, name);
    const Parameter& p = parameters()[*index];
    if (!(value >= p.least && value <= p.most)) {
        return Error{place + ": " + name + " may go from " + text_of(p.least) + " to " + text_of(p.most) + " (" +
                     std::string(p.unit) + ")"};
    }
    person.shape[*index] = value;
    return Done{};
}

double number(const Json& json, const std::string& place, double most) {
    if (!json.is_number()) refuse(place, "it is not a number");
    const double value = json.get<double>();
    if (!(value >= 0 && value <= most)) refuse(place, "it is not from 0 to " + text_of(most));
    return value;
}

std::array<double, 3> color(const Json& json, const std::string& place) {
    if (!json.is_array() || json.size() != 3) refuse(place, "it is not a list of three numbers");
    return {number(json[0], place, 1), number(json[1], place, 1), number(json[2], place, 1)};
}

void read_skin(const Json& json, SkinTone& skin) {
    if (!json.is_object()) refuse("skin", "it is not an object");
    for (const auto& [key, value] : json.items()) {
        const std::string place = "skin." + key;
        if (key == "melanin")
            skin.melanin = number(value, place, largest_melanin);
        else if (key == "melanin_blend")
            skin.melanin_blend = number(value, place, 1);
        else if (key == "hemoglobin")
            skin.hemoglobin = number(value, place, largest_hemoglobin);
        else if (key == "hair")
            skin.hair = color(value, place);
        else if (key == "eyes")
            skin.eyes = color(value, place);
        else if (key == "freckles")
            skin.freckles = number(value, place, 1);
        else
            refuse(place, "a skin has melanin, melanin_blend, hemoglobin, hair, eyes and freckles only");
    }
}

}  // namespace

Person::Person() {
    for (const Parameter& p : parameters()) shape.push_back(p.at_rest);
}

Result<Person> read_person(std::string_view text, const std::string& file) {
    const Result<Json> json = parse_json(text, file, "a person");
    if (!json) return json.error();
    Person person;
    try {
        if (!json->is_object() || !json->contains("blush_person")) {
            refuse("top level", "it is not a person: no \"blush_person\"");
        }
        for (const auto& [key, value] : json->items()) {
            if (key == "blush_person") {
                if (value != 1) refuse(key, "only version 1 is known");
            } else if (key == "name") {
                if (!value.is_string()) refuse(key, "it is not a text");
                person.name = value.get<std::string>();
            } else if (key == "shape") {
                if (!value.is_object()) refuse(key, "it is not an object");
                for (const auto& [name, amount] : value.items()) {
                    if (!amount.is_number()) refuse("shape." + name, "it is not a number");
                    if (Status s = assign(person, file + ": shape", name, amount.get<double>()); !s) return s.error();
                }
            } else if (key == "skin") {
                read_skin(value, person.skin);
            } else {
                refuse(key, "a person has name, shape and skin only");
            }
        }
    } catch (const load::BadFile& bad) {
        return Error{file + ": " + bad.place + ": " + bad.reason};
    }
    return person;
}

Status set_parameter(Person& person, std::string_view assignment) {
    const std::string all(assignment), place = "--set " + all;
    const std::size_t equals = all.find('=');
    if (equals == std::string::npos) return Error{place + ": not NAME=VALUE"};
    std::string_view digits = assignment.substr(equals + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (read.ec != std::errc() || read.ptr != digits.data() + digits.size() || !std::isfinite(value)) {
        return Error{place + ": \"" + all.substr(equals + 1) + "\" is not a finite number"};
    }
    return assign(person, "--set", all.substr(0, equals), value);
}

}  // namespace blush::make_face
