#include "runtime/files/appearance_file.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <initializer_list>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "rig/blood/colour_difference.h"
#include "runtime/files/bad_file.h"
#include "runtime/files/bytes.h"
#include "runtime/files/image_file.h"
#include "runtime/files/output_file.h"

namespace blush {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uint64_t most_file_bytes = 1ULL << 30;
constexpr std::uint32_t most_side_pixels = 16'384;
constexpr std::uint64_t most_pixel_bytes = 4ULL << 30;
constexpr std::uint64_t most_text_bytes = 1U << 20;  // of a pattern: a thousand regions

/// Runs `read` and turns what it throws into a sentence.
template <class T, class Read>
Result<T> guarded(const fs::path& path, const Read& read) {
    const std::string name = path.string();
    try {
        return read();
    } catch (const load::BadFile& bad) {
        return Error{name + ": " + (bad.place.empty() ? "" : bad.place + ": ") + bad.reason};
    } catch (const std::bad_alloc&) {
        return Error{name + ": there is not enough memory to load this file"};
    } catch (const std::exception& error) {
        return Error{name + ": the file cannot be read (" + error.what() + ")"};
    }
}

bool holds_linear_light(load::ByteView file) {
    const auto starts = [&](std::string_view magic) {
        return file.size() >= magic.size() &&
               std::equal(magic.begin(), magic.end(), file.begin(),
                          [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    };
    return starts("v/1\x01") || starts("#?");  // OpenEXR, Radiance
}

struct Decoded {
    Image image;
    bool linear = false;
};
Decoded decode(const fs::path& path) {
    const load::Bytes file = load::read_file(path, most_file_bytes, "");
    std::uint64_t pixel_bytes = most_pixel_bytes;
    return {load::decode_image(file, most_side_pixels, pixel_bytes, ""), holds_linear_light(file)};
}

float number_at(const Image& image, std::size_t i) {
    return image.bytes.empty() ? image.floats[i] : static_cast<float>(image.bytes[i]) / 255.0F;
}

ColourMap to_linear(const Image& image, bool linear) {
    if (image.channels < 3) {
        load::refuse("", "the image has " + std::to_string(image.channels) +
                             (image.channels == 1 ? " channel" : " channels") + "; skin is read from a colour texture");
    }
    ColourMap map(image.width, image.height);
    std::vector<float> table(256);
    for (std::size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255));
    }
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t k = i * image.channels + c;
            float value = 0;
            if (!image.bytes.empty()) {
                value = table[image.bytes[k]];
            } else if (std::isfinite(image.floats[k])) {
                value = linear ? image.floats[k]
                               : static_cast<float>(linear_from_srgb(static_cast<double>(image.floats[k])));
            }
            map.values[i][static_cast<glm::length_t>(c)] = value;
        }
    }
    return map;
}

Image grey_image(const ScalarMap& map) {
    Image image;
    image.width = map.width;
    image.height = map.height;
    image.channels = 1;
    image.bytes.resize(map.values.size());
    std::ranges::transform(map.values, image.bytes.begin(), [](float value) {
        return static_cast<std::uint8_t>(std::lround(255 * (value > 0 ? std::min(value, 1.0F) : 0.0F)));
    });
    return image;
}

ScalarMap table_coordinates(const ScalarMap& fractions, double largest) {
    ScalarMap map = fractions;
    for (float& value : map.values) value = table_coordinate(value, largest);
    return map;
}

ScalarMap fractions_of(ScalarMap coordinates, double largest) {
    for (float& value : coordinates.values) value = table_fraction(value, largest);
    return coordinates;
}

ScalarMap brought_to(const ScalarMap& map, std::uint32_t width, std::uint32_t height) {
    return map.width == width && map.height == height ? map : resized(map, width, height);
}

// JSON, checked key by key.

const Json& member(const Json& object, const char* key, const std::string& place) {
    const auto found = object.find(key);
    if (found == object.end()) load::refuse(place, "\"" + std::string(key) + "\" is missing");
    return *found;
}

void check_keys(const Json& object, std::initializer_list<std::string_view> known, const std::string& place) {
    if (!object.is_object()) load::refuse(place, "not an object");
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(known, key) == known.end()) load::refuse(place, "there is no key \"" + key + "\"");
    }
}

float number_of(const Json& value, double low, double high, const std::string& place) {
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= low && number <= high)) {
        const auto text = [](double x) { return Json(x).dump(); };
        load::refuse(place, "not a number from " + text(low) + " to " + text(high));
    }
    return static_cast<float>(number);
}

glm::vec2 pair_of(const Json& value, double low, double high, const std::string& place) {
    if (!value.is_array() || value.size() != 2) load::refuse(place, "not two numbers");
    return {number_of(value[0], low, high, place + "[0]"), number_of(value[1], low, high, place + "[1]")};
}

std::string text_of(const Json& value, const std::string& place) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) load::refuse(place, "not a text");
    return value.get<std::string>();
}

Json read_json(const fs::path& path) {
    const load::Bytes file = load::read_file(path, most_text_bytes, "");
    const Json json = Json::parse(file.begin(), file.end(), nullptr, false);
    if (json.is_discarded()) load::refuse("", "not JSON");
    return json;
}

/// Farther from 0 than this, a relative change is a slip of the pen: three times the blood.
constexpr double largest_relative_change = 3;

RelativeChange change_of(const Json& object, const std::string& place) {
    RelativeChange change;
    change.mean = number_of(member(object, "mean", place), -1, largest_relative_change, place + ".mean");
    change.deviation = number_of(member(object, "deviation", place), -1, largest_relative_change, place + ".deviation");
    return change;
}

HemoglobinPattern pattern_of(const Json& json) {
    check_keys(json, {"name", "summary", "sources", "everywhere", "regions"}, "");
    HemoglobinPattern pattern;
    pattern.name = text_of(member(json, "name", ""), "name");
    text_of(member(json, "summary", ""), "summary");
    const Json& everywhere = member(json, "everywhere", "");
    check_keys(everywhere, {"mean", "deviation", "because"}, "everywhere");
    pattern.everywhere = change_of(everywhere, "everywhere");
    const Json& regions = member(json, "regions", "");
    if (!regions.is_array()) load::refuse("regions", "not an array");
    for (std::size_t i = 0; i < regions.size(); ++i) {
        const Json& region = regions[i];
        const std::string place = load::at("regions", i);
        check_keys(region,
                   {"name", "centre_mm", "radii_mm", "angle_degrees", "mirrored", "mean", "deviation", "because"},
                   place);
        SoftEllipse ellipse;
        ellipse.name = text_of(member(region, "name", place), place + ".name");
        text_of(member(region, "because", place), place + ".because");
        ellipse.centre_mm = pair_of(member(region, "centre_mm", place), -300, 300, place + ".centre_mm");
        ellipse.radii_mm = pair_of(member(region, "radii_mm", place), 1, 500, place + ".radii_mm");
        const Json angle = region.value("angle_degrees", Json(0));
        ellipse.angle_radians = glm::radians(number_of(angle, -360, 360, place + ".angle_degrees"));
        const Json mirrored = region.value("mirrored", Json(true));
        if (!mirrored.is_boolean()) load::refuse(place + ".mirrored", "not true or false");
        ellipse.mirrored = mirrored.get<bool>();
        ellipse.change = change_of(region, place);
        pattern.regions.push_back(std::move(ellipse));
    }
    return pattern;
}

}  // namespace

Result<ColourMap> load_colour_map(const fs::path& path) {
    return guarded<ColourMap>(path, [&] {
        const Decoded decoded = decode(path);
        return to_linear(decoded.image, decoded.linear);
    });
}

Result<ColourMap> colour_map_of(const Image& image, const std::string& name, bool linear) {
    return guarded<ColourMap>(name, [&] { return to_linear(image, linear); });
}

Result<ScalarMap> load_scalar_map(const fs::path& path) {
    return guarded<ScalarMap>(path, [&] {
        const Image image = decode(path).image;
        ScalarMap map(image.width, image.height);
        for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = number_at(image, i * image.channels);
        return map;
    });
}

Status write_scalar_map(const fs::path& path, const ScalarMap& map) { return write_image(path, grey_image(map)); }

Status write_colour_map(const fs::path& path, const ColourMap& map) {
    Image image;
    image.width = map.width;
    image.height = map.height;
    image.channels = 3;
    const bool linear = path.extension() == ".exr";
    for (const glm::vec3& colour : map.values) {
        for (glm::length_t c = 0; c < 3; ++c) {
            if (linear) {
                constexpr float largest_half = 65504;
                image.floats.push_back(std::clamp(colour[c], -largest_half, largest_half));
            } else {
                const double encoded = srgb_from_linear(static_cast<double>(std::clamp(colour[c], 0.0F, 1.0F)));
                image.bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * encoded)));
            }
        }
    }
    return write_image(path, image);
}

Status write_appearance(const fs::path& folder, const AppearanceMaps& maps) {
    const auto write = [&](const char* name, const ScalarMap& map) { return write_scalar_map(folder / name, map); };
    if (Status s = write("melanin.png", table_coordinates(maps.melanin, largest_melanin)); !s) return s;
    if (Status s = write("hemoglobin.png", table_coordinates(maps.hemoglobin, largest_hemoglobin)); !s) return s;
    if (Status s = write("skin.png", maps.skin); !s) return s;
    return write_colour_map(folder / "residual.exr", maps.residual);
}

Result<AppearanceMaps> load_appearance(const fs::path& folder) {
    std::error_code failed;
    if (!fs::is_directory(folder, failed)) return Error{folder.string() + ": there is no such folder"};
    Result<ScalarMap> hemoglobin = load_scalar_map(folder / "hemoglobin.png");
    if (!hemoglobin) return hemoglobin.error();
    Result<ScalarMap> melanin = load_scalar_map(folder / "melanin.png");
    if (!melanin) return melanin.error();
    const std::uint32_t width = hemoglobin->width, height = hemoglobin->height;
    AppearanceMaps maps;
    maps.hemoglobin = fractions_of(*std::move(hemoglobin), largest_hemoglobin);
    maps.melanin = fractions_of(brought_to(*melanin, width, height), largest_melanin);
    maps.skin = ScalarMap(width, height, 1);
    maps.residual = ColourMap(width, height, glm::vec3(1));
    if (const fs::path path = folder / "skin.png"; fs::exists(path, failed)) {
        const Result<ScalarMap> skin = load_scalar_map(path);
        if (!skin) return skin.error();
        maps.skin = brought_to(*skin, width, height);
    }
    if (const fs::path path = folder / "residual.exr"; fs::exists(path, failed)) {
        const Result<ColourMap> residual = load_colour_map(path);
        if (!residual) return residual.error();
        maps.residual = residual->same_size(maps.skin) ? *residual : resized(*residual, width, height);
    }
    return maps;
}

Status write_hemoglobin_maps(const fs::path& folder, const HemoglobinMaps& maps) {
    for (std::size_t i = 0; i < maps.names.size(); ++i) {
        const HemoglobinChange& change = maps.changes[i];
        ColourMap colours(change.scale.width, change.scale.height);
        for (std::size_t k = 0; k < colours.values.size(); ++k) {
            colours.values[k] = {change.scale.values[k], change.offset.values[k], 0};
        }
        if (Status s = write_colour_map(folder / (maps.names[i] + ".exr"), colours); !s) return s;
    }
    return Done{};
}

namespace {

/// Scale and offset of one expression. Texels that are not finite change nothing.
Result<HemoglobinChange> load_change(const fs::path& path) {
    return guarded<HemoglobinChange>(path, [&] {
        constexpr std::uint32_t most_side = 4096;
        const Image image = decode(path).image;
        if (image.channels < 2) load::refuse("", "the image has 1 channel; scale and offset stand in the first two");
        if (image.width > most_side || image.height > most_side)
            load::refuse("", "more than " + std::to_string(most_side) + " texels a side");
        HemoglobinChange change{ScalarMap(image.width, image.height, 1), ScalarMap(image.width, image.height)};
        for (std::size_t i = 0; i < change.scale.values.size(); ++i) {
            const float scale = number_at(image, i * image.channels), offset = number_at(image, i * image.channels + 1);
            if (!std::isfinite(scale) || !std::isfinite(offset)) continue;
            change.scale.values[i] = std::clamp(scale, 0.0F, largest_hemoglobin_scale);
            change.offset.values[i] = offset;
        }
        return change;
    });
}

}  // namespace

Result<HemoglobinMaps> load_hemoglobin_maps(const fs::path& folder) {
    HemoglobinMaps maps;
    for (const std::string_view name : hemoglobin_pattern_names) {
        const fs::path path = folder / (std::string(name) + ".exr");
        std::error_code failed;
        if (!fs::exists(path, failed)) continue;
        const Result<HemoglobinChange> read = load_change(path);
        if (!read) return read.error();
        const HemoglobinChange& change = *read;
        if (!maps.changes.empty() && !maps.changes[0].scale.same_size(change.scale))
            return Error{path.string() + ": its size is not that of " + maps.names[0] + ".exr"};
        maps.names.emplace_back(name);
        maps.changes.push_back(change);
    }
    return maps;
}

Result<HemoglobinPattern> load_hemoglobin_pattern(const fs::path& path) {
    return guarded<HemoglobinPattern>(path, [&] { return pattern_of(read_json(path)); });
}

Result<std::vector<HemoglobinPattern>> load_hemoglobin_patterns(const fs::path& folder) {
    std::vector<HemoglobinPattern> patterns;
    for (const std::string_view name : hemoglobin_pattern_names) {
        const fs::path path = folder / (std::string(name) + ".json");
        Result<HemoglobinPattern> pattern = load_hemoglobin_pattern(path);
        if (!pattern) return pattern.error();
        if (pattern->name != name) return Error{path.string() + ": name: \"" + pattern->name + "\" is not the file's"};
        patterns.push_back(*std::move(pattern));
    }
    return patterns;
}

Result<TextureLandmarks> load_texture_landmarks(const fs::path& path) {
    return guarded<TextureLandmarks>(path, [&] {
        const Json json = read_json(path);
        check_keys(json, {"left_eye", "right_eye", "mouth"}, "");
        const auto place = [&](const char* key) { return pair_of(member(json, key, ""), -16, 16, key); };
        return TextureLandmarks{place("left_eye"), place("right_eye"), place("mouth")};
    });
}

}  // namespace blush
