#include "runtime/files/wrinkle_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>

#include "runtime/files/bad_file.h"
#include "runtime/files/bytes.h"
#include "runtime/files/image_file.h"
#include "runtime/files/output_file.h"

namespace blush {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::uint64_t most_file_bytes = 1ULL << 28;
constexpr std::uint32_t most_side_texels = 8192;
constexpr const char* derivatives_name = "wrinkles";
constexpr std::array<const char*, most_wrinkle_masks> mask_names = {"wrinkle_mask_1", "wrinkle_mask_2",
                                                                    "wrinkle_mask_3"};
constexpr std::size_t zones_a_mask = zones_a_wrinkle_mask;

struct Picture {
    fs::path path;
    Image image;
};

/// NAME.png, or NAME.exr where there is none.
Picture read_picture(const fs::path& folder, const std::string& name) {
    std::error_code failed;
    Picture picture{folder / (name + ".png"), {}};
    if (!fs::exists(picture.path, failed) && fs::exists(folder / (name + ".exr"), failed))
        picture.path = folder / (name + ".exr");
    const std::string place = picture.path.filename().string();
    const load::Bytes file = load::read_file(picture.path, most_file_bytes, place);
    std::uint64_t pixel_bytes = std::uint64_t{most_side_texels} * most_side_texels * 16;
    picture.image = load::decode_image(file, most_side_texels, pixel_bytes, place);
    return picture;
}

void want_channels(const Picture& picture, std::uint32_t channels, const std::string& what) {
    if (picture.image.channels >= channels) return;
    load::refuse(picture.path.filename().string(), "the image has " + std::to_string(picture.image.channels) +
                                                       (picture.image.channels == 1 ? " channel; " : " channels; ") +
                                                       what);
}

bool is_linear(const Picture& picture) { return picture.path.extension() == ".exr"; }

/// A channel of a texel, 0 to 1 for whole numbers. What is not finite counts as `otherwise`.
float number_at(const Image& image, std::size_t texel, std::uint32_t channel, float otherwise) {
    const std::size_t i = texel * image.channels + channel;
    if (!image.bytes.empty()) return static_cast<float>(image.bytes[i]) / 255.0F;
    return std::isfinite(image.floats[i]) ? image.floats[i] : otherwise;
}

/// 128 is 0, 1 and 255 are the ends of the range; so 0, which would lie beyond, counts as its end.
float derivative_of(float stored, float range) {
    return std::clamp((stored * 255.0F - 128.0F) / 127.0F, -1.0F, 1.0F) * range;
}

/// Beyond a part there are no folds; clamped lookups find the outermost texels.
void clear_border(ScalarMap& mask) {
    for (std::uint32_t y = 0; y < mask.height; ++y) {
        for (std::uint32_t x = 0; x < mask.width; ++x) {
            if (x == 0 || y == 0 || x + 1 == mask.width || y + 1 == mask.height) mask.at(x, y) = 0;
        }
    }
}

DerivativeMap derivatives_of(const Picture& picture, float range) {
    want_channels(picture, 2, "partial derivatives stand in red and green");
    DerivativeMap map(picture.image.width, picture.image.height);
    const bool linear = is_linear(picture);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        for (std::uint32_t c = 0; c < 2; ++c) {
            constexpr float flat = 128.0F / 255.0F;
            const float number = number_at(picture.image, i, c, linear ? 0 : flat);
            map.values[i][static_cast<glm::length_t>(c)] =
                linear ? std::clamp(number, -range, range) : derivative_of(number, range);
        }
    }
    return map;
}

Json read_description(const fs::path& folder) {
    const load::Bytes file = load::read_file(folder / "wrinkles.json", 1U << 16U, "wrinkles.json");
    Json json = Json::parse(file.begin(), file.end(), nullptr, false);
    if (json.is_discarded() || !json.is_object()) load::refuse("wrinkles.json", "not a JSON object");
    for (const auto& [key, value] : json.items()) {
        if (key != "zones" && key != "range" && key != "layout_from" && key != "layout_to")
            load::refuse("wrinkles.json", "there is no key \"" + key + "\"");
    }
    return json;
}

glm::vec2 corner_of(const Json& json, const char* key, glm::vec2 otherwise) {
    const auto found = json.find(key);
    if (found == json.end()) return otherwise;
    glm::vec2 corner(-1);
    if (found->is_array() && found->size() == 2 && (*found)[0].is_number() && (*found)[1].is_number())
        corner = {(*found)[0].get<float>(), (*found)[1].get<float>()};
    if (!(corner.x >= 0 && corner.x <= 1 && corner.y >= 0 && corner.y <= 1))
        load::refuse(std::string("wrinkles.json: ") + key, "not an array of two numbers from 0 to 1");
    return corner;
}

WrinkleSet read_set(const fs::path& folder) {
    WrinkleSet set;
    const Json json = read_description(folder);
    const auto zones = json.find("zones");
    if (zones == json.end() || !zones->is_array() || zones->empty() || zones->size() > most_wrinkle_zones)
        load::refuse("wrinkles.json: zones", "not an array of 1 to " + std::to_string(most_wrinkle_zones) + " names");
    for (const Json& zone : *zones) {
        if (!zone.is_string()) load::refuse("wrinkles.json: zones", "not an array of names");
        set.zones.push_back(zone.get<std::string>());
    }
    const Json range = json.value("range", Json(published_derivative_range));
    set.range = range.is_number() ? range.get<float>() : 0;
    if (!(set.range > 0 && set.range <= largest_derivative_range))
        load::refuse("wrinkles.json: range",
                     "not a number above 0, to " + std::to_string(static_cast<int>(largest_derivative_range)));

    set.part = {corner_of(json, "layout_from", glm::vec2(0)), corner_of(json, "layout_to", glm::vec2(1))};
    if (!glm::all(glm::lessThan(set.part.from, set.part.to)))
        load::refuse("wrinkles.json: layout_to", "not beyond layout_from");

    set.derivatives = derivatives_of(read_picture(folder, derivatives_name), set.range);
    for (std::size_t m = 0; m * zones_a_mask < set.zones.size(); ++m) {
        const Picture picture = read_picture(folder, mask_names[m]);
        const std::size_t here = std::min(set.zones.size() - m * zones_a_mask, zones_a_mask);
        want_channels(picture, static_cast<std::uint32_t>(here),
                      "wrinkles.json names " + std::to_string(here) + " zones for it");
        if (!set.masks.empty() &&
            (set.masks[0].width != picture.image.width || set.masks[0].height != picture.image.height))
            load::refuse(picture.path.filename().string(),
                         "is " + std::to_string(picture.image.width) + "x" + std::to_string(picture.image.height) +
                             " texels and " + mask_names[0] + " " + std::to_string(set.masks[0].width) + "x" +
                             std::to_string(set.masks[0].height) + "; masks are of one size");
        for (std::uint32_t c = 0; c < here; ++c) {
            ScalarMap mask(picture.image.width, picture.image.height);
            for (std::size_t i = 0; i < mask.values.size(); ++i)
                mask.values[i] = std::clamp(number_at(picture.image, i, c, 0), 0.0F, 1.0F);
            if (!set.part.is_whole()) clear_border(mask);
            set.masks.push_back(std::move(mask));
        }
    }
    return set;
}

Image blank(std::uint32_t width, std::uint32_t height, std::uint32_t channels) {
    Image image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.bytes.resize(std::size_t{width} * height * channels);
    return image;
}

/// Four channels of weights are not a colour with its opacity: the picture is encoded as it is.
Status write_png(const fs::path& path, const Image& image) {
    const load::Bytes png = load::encode_png(image.width, image.height, image.channels, image.bytes);
    return write_file(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace

Status write_wrinkles(const fs::path& folder, const WrinkleSet& wrinkles) {
    if (wrinkles.zones.size() > most_wrinkle_zones) {
        return Error{folder.string() + ": " + std::to_string(wrinkles.zones.size()) +
                     " wrinkle zones; the masks hold " + std::to_string(most_wrinkle_zones)};
    }
    // The third channel is for the eye: the file then looks as figure 8.3 does.
    Image derivatives = blank(wrinkles.derivatives.width, wrinkles.derivatives.height, 3);
    for (std::size_t i = 0; i < wrinkles.derivatives.values.size(); ++i) {
        for (std::size_t c = 0; c < 2; ++c)
            derivatives.bytes[3 * i + c] = static_cast<std::uint8_t>(
                128 + stored_derivative(wrinkles.derivatives.values[i][static_cast<glm::length_t>(c)], wrinkles.range));
    }
    if (Status s = write_png(folder / (std::string(derivatives_name) + ".png"), derivatives); !s) return s;
    for (std::size_t m = 0; m * zones_a_mask < wrinkles.masks.size(); ++m) {
        Image masks = blank(wrinkles.masks[0].width, wrinkles.masks[0].height, zones_a_mask);
        for (std::size_t c = 0; c < zones_a_mask && m * zones_a_mask + c < wrinkles.masks.size(); ++c) {
            const ScalarMap& mask = wrinkles.masks[m * zones_a_mask + c];
            for (std::size_t i = 0; i < mask.values.size(); ++i)
                masks.bytes[zones_a_mask * i + c] =
                    static_cast<std::uint8_t>(std::lround(255 * std::clamp(mask.values[i], 0.0F, 1.0F)));
        }
        if (Status s = write_png(folder / (std::string(mask_names[m]) + ".png"), masks); !s) return s;
    }
    Json json = {{"zones", wrinkles.zones}, {"range", wrinkles.range}};
    if (!wrinkles.part.is_whole()) {
        json["layout_from"] = {wrinkles.part.from.x, wrinkles.part.from.y};
        json["layout_to"] = {wrinkles.part.to.x, wrinkles.part.to.y};
    }
    return write_file(folder / "wrinkles.json", json.dump(2) + "\n");
}

Result<WrinkleSet> load_wrinkles(const fs::path& folder) {
    const std::string name = folder.string();
    try {
        return read_set(folder);
    } catch (const load::BadFile& bad) {
        return Error{name + ": " + (bad.place.empty() ? "" : bad.place + ": ") + bad.reason};
    } catch (const std::bad_alloc&) {
        return Error{name + ": there is not enough memory to load these maps"};
    } catch (const std::exception& error) {
        return Error{name + ": the maps cannot be read (" + error.what() + ")"};
    }
}

}  // namespace blush
