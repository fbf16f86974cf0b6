#include "runtime/files/lighting_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "runtime/files/bad_file.h"
#include "runtime/files/image_file.h"

namespace blush {
namespace {

using load::refuse;
using nlohmann::json;

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 20;  // a list of lights has a few thousand

double number(const json& object, const char* name, double otherwise, double low, double high,
              const std::string& place) {
    const auto found = object.find(name);
    if (found == object.end()) return otherwise;
    if (!found->is_number()) refuse(place + "." + name, "it is not a number");
    const double value = found->get<double>();
    if (!(value >= low && value <= high)) {
        refuse(place + "." + name, "it is not from " + json(low).dump() + " to " + json(high).dump());
    }
    return value;
}

glm::vec3 triple(const json& object, const char* name, const std::string& place, double limit) {
    const std::string here = place + "." + name;
    const auto found = object.find(name);
    if (found == object.end()) refuse(here, "it is missing");
    if (!found->is_array() || found->size() != 3) refuse(here, "it is not a list of three numbers");
    glm::vec3 result(0);
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(*found)[c].is_number()) refuse(here, "it is not a list of three numbers");
        const double value = (*found)[c].get<double>();
        if (!(std::abs(value) <= limit)) refuse(here, "a number in it is beyond " + json(limit).dump());
        result[static_cast<glm::length_t>(c)] = static_cast<float>(value);
    }
    return result;
}

glm::vec3 radiance(const json& object, const char* name, const std::string& place) {
    const glm::vec3 value = triple(object, name, place, 1e4);
    if (std::min({value.x, value.y, value.z}) < 0) refuse(place + "." + name, "a number in it is below 0");
    return value;
}

LightSource light_from(const json& object, const std::string& place, glm::vec3 centre, double millimetres_a_unit) {
    if (!object.is_object()) refuse(place, "it is not an object");
    LightSource light;
    const std::string kind = object.value("kind", json("")).is_string() ? object.value("kind", std::string()) : "";
    constexpr std::array<std::string_view, 3> kinds = {"directional", "point", "spot"};
    const auto found = std::ranges::find(kinds, kind);
    if (found == kinds.end()) refuse(place + ".kind", "it is none of directional, point, spot");
    light.kind = static_cast<LightKind>(found - kinds.begin());
    light.radiance_linear = radiance(object, "radiance", place);
    const double scale = 1 / millimetres_a_unit;
    if (light.kind == LightKind::directional) {
        light.direction_world = -triple(object, "from", place, 1e6);
        if (glm::length(light.direction_world) < 1e-6F) refuse(place + ".from", "it has no direction");
    } else {
        const glm::vec3 offset = triple(object, "at_mm", place, 1e7);
        light.position_world = glm::dvec3(centre) + glm::dvec3(offset) * scale;
        light.direction_world = glm::vec3(glm::dvec3(centre) - light.position_world);
        const auto length = static_cast<double>(glm::length(offset));
        light.reference_distance =
            static_cast<float>(number(object, "reference_mm", std::max(length, 1.0), 1, 1e7, place) * scale);
        if (light.kind == LightKind::spot) {
            if (object.contains("towards")) light.direction_world = triple(object, "towards", place, 1e6);
            if (glm::length(light.direction_world) < 1e-12F) refuse(place + ".towards", "it has no direction");
            const double outer = number(object, "outer_degrees", 30, 0.1, 85, place);
            light.outer_radians = static_cast<float>(glm::radians(outer));
            light.inner_radians =
                static_cast<float>(glm::radians(number(object, "inner_degrees", 0.8 * outer, 0, outer, place)));
        }
    }
    light.orbit_seconds = static_cast<float>(number(object, "orbit_seconds", 0, -1e6, 1e6, place));
    if (light.orbit_seconds != 0 && std::abs(light.orbit_seconds) < 0.1F) {
        refuse(place + ".orbit_seconds", "a light goes round in a tenth of a second at least");
    }
    // Half of what it measures across: a light has a radius.
    light.size = light.kind == LightKind::directional
                     ? static_cast<float>(glm::radians(0.5 * number(object, "size_degrees", 0, 0, 57, place)))
                     : static_cast<float>(0.5 * number(object, "size_mm", 0, 0, 1e6, place) * scale);
    const auto casts = object.find("casts_shadow");
    if (casts != object.end()) {
        if (!casts->is_boolean()) refuse(place + ".casts_shadow", "it is neither true nor false");
        light.casts_shadow = casts->get<bool>();
    }
    return light;
}

/// A studio lamp behind an umbrella: half a metre wide at four metres.
LightSource from(glm::vec3 towards, glm::vec3 radiance_linear) {
    LightSource light;
    light.size = 0.0625F;
    light.direction_world = -glm::normalize(towards);
    light.radiance_linear = radiance_linear;
    return light;
}

}  // namespace

Result<Lighting> named_lighting(std::string_view name) {
    Lighting lighting;
    lighting.sky_radiance_linear = {0.06F, 0.065F, 0.075F};
    lighting.ground_radiance_linear = {0.03F, 0.027F, 0.025F};
    if (name == "front") {
        lighting.lights = {from({0.2F, 0.3F, 1}, {1.9F, 1.85F, 1.8F})};
    } else if (name == "side") {
        lighting.lights = {from({-1, 0.25F, 0.15F}, {2.2F, 2.1F, 2.0F})};
    } else if (name == "behind") {
        lighting.lights = {from({0.25F, 0.3F, -1}, {6, 5.8F, 5.5F}), from({-0.5F, 0.2F, 1}, {0.12F, 0.14F, 0.18F})};
    } else if (name == "orbit") {
        constexpr float minute_seconds = 60;
        // Ears need a light behind them that is twenty times as bright as the one in front; with automatic exposure the
        // face is not too bright when it comes round.
        lighting.lights = {from({-0.3F, 0.3F, 1}, {5.0F, 4.8F, 4.5F}), from({0.25F, 0.35F, 1}, {0.25F, 0.25F, 0.265F})};
        lighting.lights[0].orbit_seconds = minute_seconds;
        lighting.lights[1].casts_shadow = false;
        lighting.sky_radiance_linear = {0.06F, 0.065F, 0.07F};
        lighting.ground_radiance_linear = {0.024F, 0.022F, 0.021F};
    } else {
        return Error{"there is no lighting \"" + std::string(name) +
                     "\" (there are: front, side, behind, orbit; or a .json file)"};
    }
    return lighting;
}

Result<Lighting> read_lighting(const std::filesystem::path& path, const Bounds& head, double millimetres_a_unit) {
    try {
        std::error_code failed;
        const std::uintmax_t bytes = std::filesystem::file_size(path, failed);
        if (failed) return Error{path.string() + ": " + failed.message()};
        if (bytes > most_bytes) return Error{path.string() + ": larger than 1 MiB, which no list of lights is"};
        std::ifstream file(path, std::ios::binary);
        if (!file) return Error{path.string() + ": cannot be opened"};
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        const json root = json::parse(text, nullptr, false);
        if (root.is_discarded() || !root.is_object()) return Error{path.string() + ": not a JSON object"};
        Lighting lighting;
        lighting.orbit_centre_world = head.centre();
        if (root.contains("sky")) lighting.sky_radiance_linear = radiance(root, "sky", "root");
        if (root.contains("ground")) lighting.ground_radiance_linear = radiance(root, "ground", "root");
        const auto lights = root.find("lights");
        if (lights == root.end() || !lights->is_array()) return Error{path.string() + ": lights: it is not a list"};
        constexpr std::size_t most_lights = 8;  // BLUSH_MOST_LIGHTS
        if (lights->size() > most_lights) return Error{path.string() + ": lights: more than 8"};
        for (std::size_t i = 0; i < lights->size(); ++i) {
            lighting.lights.push_back(
                light_from((*lights)[i], "lights[" + std::to_string(i) + "]", head.centre(), millimetres_a_unit));
        }
        return lighting;
    } catch (const load::BadFile& bad) {
        return Error{path.string() + ": " + bad.place + ": " + bad.reason};
    } catch (const std::exception& unexpected) {
        return Error{path.string() + ": " + unexpected.what()};
    }
}

Result<std::shared_ptr<const Environment>> read_environment(const std::filesystem::path& path) {
    try {
        std::error_code failed;
        const std::uintmax_t bytes = std::filesystem::file_size(path, failed);
        if (failed) return Error{path.string() + ": " + failed.message()};
        constexpr std::uintmax_t most = std::uintmax_t{512} << 20;
        if (bytes > most) return Error{path.string() + ": larger than 512 MiB"};
        std::ifstream file(path, std::ios::binary);
        if (!file) return Error{path.string() + ": cannot be opened"};
        std::vector<std::uint8_t> encoded(static_cast<std::size_t>(bytes));
        file.read(reinterpret_cast<char*>(encoded.data()), static_cast<std::streamsize>(bytes));
        std::uint64_t pixel_bytes = std::uint64_t{2} << 30;
        constexpr std::uint32_t most_side = 16'384;
        const Image image = load::decode_image(encoded, most_side, pixel_bytes, path.string());
        return make_environment(image);
    } catch (const load::BadFile& bad) {
        return Error{bad.place + ": " + bad.reason};
    } catch (const std::exception& bad) {
        return Error{path.string() + ": " + bad.what()};
    }
}

}  // namespace blush
