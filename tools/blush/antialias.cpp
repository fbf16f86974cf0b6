/// blush antialias: MLAA or SMAA 1x over any picture.

#include <iostream>
#include <optional>

#include "runtime/antialias/filter_picture.h"
#include "runtime/files/picture_file.h"
#include "tools/blush/commands.h"

namespace blush::tool {
namespace {

struct Options {
    std::string input, output, mode = "smaa1x", preset = "high", on = "gpu", edges_file, weights_file, depth_file;
    std::string edges_from = "luma", blend = "linear", transfer = "auto";
    std::optional<float> threshold, depth_threshold, contrast_factor, corner_rounding;
    std::optional<int> search_steps, diagonal_search_steps;
    Predication predication;
};

Pixels pixels_of(const Image& image) {
    Pixels pixels(static_cast<int>(image.width), static_cast<int>(image.height));
    const std::size_t channels = image.channels;
    for (std::size_t p = 0; p < pixels.cells.size(); ++p) {
        const auto value = [&](std::size_t c) {
            const std::size_t i = p * channels + c;
            return image.bytes.empty() ? image.floats[i] : static_cast<float>(image.bytes[i]) / 255.0F;
        };
        const bool gray = channels < 3;
        const bool has_alpha = channels == 2 || channels == 4;
        pixels.cells[p] = {value(0), value(gray ? 0 : 1), value(gray ? 0 : 2), has_alpha ? value(channels - 1) : 1.0F};
    }
    return pixels;
}

/// Writes the pixels over the image, whose channels and numbers they came from. How many pixels changed.
std::size_t put_into(const Pixels& pixels, Image& image) {
    const std::size_t channels = image.channels;
    std::size_t changed = 0;
    for (std::size_t p = 0; p < pixels.cells.size(); ++p) {
        bool differs = false;
        const auto put = [&](auto& number, auto value) {
            differs |= number != value;
            number = value;
        };
        for (std::size_t c = 0; c < channels; ++c) {
            const bool alpha = (channels == 2 || channels == 4) && c == channels - 1;
            const float value = pixels.cells[p][alpha ? 3 : static_cast<glm::length_t>(c)];
            const std::size_t i = p * channels + c;
            if (image.bytes.empty()) {
                put(image.floats[i], value);
            } else {
                put(image.bytes[i], static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F));
            }
        }
        changed += differs ? 1U : 0U;
    }
    return changed;
}

/// Three channels of 8 bits.
template <class Color>
Status write_colors(const std::string& path, int width, int height, Color color) {
    PictureFile picture;
    picture.image.width = static_cast<std::uint32_t>(width);
    picture.image.height = static_cast<std::uint32_t>(height);
    picture.image.channels = 3;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::u8vec3 c = color(x, y);
            picture.image.bytes.insert(picture.image.bytes.end(), {c.x, c.y, c.z});
        }
    }
    return write_picture(path, picture);
}

Result<FilterRequest> request_of(const Options& options, const PictureFile& picture) {
    FilterRequest request;
    request.filter = options.mode == "mlaa" ? SpatialFilter::mlaa : SpatialFilter::smaa1x;
    request.eight_bits = !picture.image.bytes.empty();
    const auto preset = std::ranges::find(smaa_preset_names, options.preset) - smaa_preset_names.begin();
    request.smaa = smaa_preset(static_cast<SmaaPreset>(preset));
    for (EdgeSettings* edges : {&request.mlaa.edges, &request.smaa.edges}) {
        edges->source = options.edges_from == "luma"    ? EdgeSource::luma
                        : options.edges_from == "color" ? EdgeSource::color
                                                        : EdgeSource::depth;
        edges->threshold = options.threshold.value_or(edges->threshold);
        edges->depth_threshold = options.depth_threshold.value_or(edges->depth_threshold);
        edges->contrast_factor = options.contrast_factor.value_or(edges->contrast_factor);
        edges->predication = options.predication;
    }
    request.smaa.search_steps = options.search_steps.value_or(request.smaa.search_steps);
    request.smaa.diagonal_search_steps = options.diagonal_search_steps.value_or(request.smaa.diagonal_search_steps);
    request.smaa.corner_rounding = options.corner_rounding.value_or(request.smaa.corner_rounding);
    request.mlaa.search_steps = options.search_steps.value_or(request.mlaa.search_steps);
    if (request.filter == SpatialFilter::mlaa) {
        if (options.diagonal_search_steps)
            return Error{"--diagonal-steps goes with --mode smaa1x: MLAA has no diagonals"};
        if (options.corner_rounding)
            return Error{"--corner-rounding goes with --mode smaa1x: MLAA rounds every corner"};
        if (request.mlaa.search_steps > largest_mlaa_search_steps) {
            return Error{"--search-steps " + std::to_string(request.mlaa.search_steps) +
                         ": MLAA's area table reaches 8 pixels, which is 4 steps"};
        }
    }
    const bool needs_depth = options.edges_from == "depth" || options.predication.on;
    if (needs_depth && options.depth_file.empty()) {
        return Error{options.predication.on ? "--predication needs --depth FILE"
                                            : "--edges-from depth needs --depth FILE"};
    }
    if (!needs_depth && !options.depth_file.empty()) {
        return Error{"--depth is used with --edges-from depth or --predication alone"};
    }
    const bool linear = options.transfer == "auto" ? picture.linear : options.transfer == "linear";
    const bool has_alpha = picture.image.channels == 2 || picture.image.channels == 4;
    request.meaning.transfer = linear ? Transfer::linear : Transfer::srgb;
    request.meaning.blend_in_linear_light = options.blend == "linear";
    request.meaning.alpha = !has_alpha                    ? AlphaMeaning::carried
                            : picture.premultiplied_alpha ? AlphaMeaning::premultiplied
                                                          : AlphaMeaning::straight;
    return request;
}

Result<PictureFile> load(const std::string& path) {
    Result<PictureFile> picture = load_picture(path);
    if (!picture) return picture;
    // Four floats a pixel, several times over.
    constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26;
    if (std::uint64_t{picture->image.width} * picture->image.height > most_pixels) {
        return Error{path + ": the picture is " + std::to_string(picture->image.width) + "x" +
                     std::to_string(picture->image.height) + "; it may have " + std::to_string(most_pixels) +
                     " pixels"};
    }
    return picture;
}

Result<DepthPixels> load_depth(const std::string& path, const Pixels& picture) {
    if (path.empty()) return DepthPixels();
    const Result<PictureFile> file = load(path);
    if (!file) return file.error();
    const Pixels pixels = pixels_of(file->image);
    if (pixels.width != picture.width || pixels.height != picture.height) {
        return Error{path + ": the depth is " + std::to_string(pixels.width) + "x" + std::to_string(pixels.height) +
                     " pixels and the picture " + std::to_string(picture.width) + "x" + std::to_string(picture.height)};
    }
    DepthPixels depth(pixels.width, pixels.height);
    std::ranges::transform(pixels.cells, depth.cells.begin(), [](const glm::vec4& texel) { return texel.x; });
    return depth;
}

Result<FilteredPicture> filter(const Options& options, const Pixels& pixels, const DepthPixels& depth,
                               const FilterRequest& request) {
    if (options.on == "cpu") return filter_on_cpu(pixels, depth, request);
    const Result<Device> device = Device::headless();
    if (!device) return device.error();
    return filter_on_gpu(*device, pixels, depth, request);
}

int antialias(const Options& options) {
    // All three before anything is written, so that nothing is left behind by a command that fails.
    for (const std::string* path : {&options.output, &options.edges_file, &options.weights_file}) {
        if (path->empty()) continue;
        if (Status writable = can_write_picture(*path); !writable) return fail(writable.error());
    }
    Result<PictureFile> picture = load(options.input);
    if (!picture) return fail(picture.error());
    const std::string ending = std::filesystem::path(options.output).extension().string();
    if (picture->linear != (ending == ".exr" || ending == ".hdr")) {
        return fail({options.output + ": " + options.input +
                     (picture->linear ? " holds linear light, which goes into a .exr or .hdr file"
                                      : " holds display values, which do not go into a " + ending + " file")});
    }
    const Result<FilterRequest> request = request_of(options, *picture);
    if (!request) return fail(request.error());
    const Pixels pixels = pixels_of(picture->image);
    const Result<DepthPixels> depth = load_depth(options.depth_file, pixels);
    if (!depth) return fail(depth.error());
    const Result<FilteredPicture> filtered = filter(options, pixels, *depth, *request);
    if (!filtered) return fail(filtered.error());

    const int width = pixels.width, height = pixels.height;
    const std::size_t changed = put_into(filtered->picture, picture->image);
    if (Status written = write_picture(options.output, *picture); !written) return fail(written.error());
    if (!options.edges_file.empty()) {
        const auto color = [&](int x, int y) {
            const glm::u8vec2 edge = filtered->edges.at(x, y) * std::uint8_t{255};
            return glm::u8vec3(edge.x, edge.y, 0);
        };
        if (Status written = write_colors(options.edges_file, width, height, color); !written)
            return fail(written.error());
    }
    if (!options.weights_file.empty()) {
        const auto color = [&](int x, int y) {
            const glm::u8vec4 w = filtered->weights.at(x, y);
            return glm::u8vec3(w.x, w.y, std::max(w.z, w.w));
        };
        if (Status written = write_colors(options.weights_file, width, height, color); !written)
            return fail(written.error());
    }
    std::size_t edge_count = 0;
    for (const glm::u8vec2 edge : filtered->edges.cells) edge_count += std::size_t{edge.x} + edge.y;
    std::cout << options.output << ": " << width << "x" << height << ", " << edge_count << " edges, " << changed
              << " pixels changed\n";
    return 0;
}

}  // namespace

void add_antialias(Command& program) {
    auto options = std::make_shared<Options>();
    Command command = program.subcommand("antialias", "Smooth the edges of a picture: SMAA 1x, or MLAA");
    command.option("IN", &options->input, "A PNG, JPEG, WebP, Radiance HDR or OpenEXR file; its first four channels")
        .required();
    command
        .option("-o,--output", &options->output,
                "A .png, .jpg or .tif file, or .exr or .hdr from one of those; keeps 16 bits and alpha where the "
                "format can")
        .required();
    command.option("--mode", &options->mode, "The filter").one_of({"smaa1x", "mlaa"}).shows_default();
    command.option("--preset", &options->preset, "Threshold and reach of SMAA's searches")
        .one_of(std::vector<std::string>(smaa_preset_names.begin(), smaa_preset_names.end()))
        .shows_default();
    command.option("--on", &options->on, "Where to compute").one_of({"cpu", "gpu"}).shows_default();
    command.option("--edges", &options->edges_file,
                   "Write the edges too: red left, green upper boundary of each pixel");
    command.option("--weights", &options->weights_file,
                   "Write the weights too: red what a pixel takes through its upper boundary, green what the "
                   "pixel above takes, blue the larger of both at its left boundary");
    command.option("--threshold", &options->threshold, "Contrast from which there is an edge; lower finds more")
        .range(0, 0.5);
    command.option("--edges-from", &options->edges_from, "Where edges are looked for")
        .one_of({"luma", "color", "depth"})
        .shows_default();
    command.option("--depth", &options->depth_file, "A picture as large as IN whose first channel is depth, 0 to 1");
    command
        .option("--depth-threshold", &options->depth_threshold,
                "Difference of depth from which there is an edge (0.01)")
        .range(0, 1);
    command
        .option("--contrast-factor", &options->contrast_factor,
                "Drop edges below this share of the contrast beside them (0.5 for SMAA; 0: none)")
        .range(0, 1);
    command
        .option("--search-steps", &options->search_steps, "Reach along a line, in steps of two pixels; MLAA: up to 4")
        .range(1, largest_search_steps);
    command
        .option("--diagonal-steps", &options->diagonal_search_steps,
                "Reach along a diagonal, in pixels; 0: no diagonals")
        .range(0, largest_diagonal_search_steps);
    command.option("--corner-rounding", &options->corner_rounding, "How much a sharp corner is rounded").range(0, 1);
    command.flag("--predication", options->predication.on,
                 "Lower the threshold where depth has an edge, raise it elsewhere");
    command.option("--predication-threshold", &options->predication.depth_threshold, "Difference of depth that counts")
        .range(0, 1)
        .shows_default();
    command.option("--predication-scale", &options->predication.scale, "Factor on the threshold")
        .range(1, 5)
        .shows_default();
    command
        .option("--predication-strength", &options->predication.strength,
                "How much of it is taken away at a silhouette")
        .range(0, 1)
        .shows_default();
    command
        .option("--blend", &options->blend, "Mix neighbours in linear light, or the file's numbers as they are (gamma)")
        .one_of({"linear", "gamma"})
        .shows_default();
    command
        .option("--transfer", &options->transfer,
                "What the file's numbers are; auto: linear in .exr and .hdr files, sRGB in others")
        .one_of({"auto", "srgb", "linear"})
        .shows_default();
    command.runs([options] { return antialias(*options); });
}

}  // namespace blush::tool
