#include "runtime/files/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "runtime/files/bad_file.h"
#include "runtime/files/png_check.h"

namespace blush::load {
namespace {

struct Signature {
    std::string_view bytes, format;
};
constexpr Signature signatures[] = {{"\x89PNG\r\n\x1A\n", "png"},
                                    {"\xFF\xD8\xFF", "jpg"},
                                    {"v/1\x01", "exr"},
                                    {"#?RADIANCE", "hdr"},
                                    {"#?RGBE", "hdr"}};

bool starts_with(ByteView bytes, std::string_view prefix) {
    return bytes.size() >= prefix.size() &&
           std::equal(prefix.begin(), prefix.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

std::string format_of(ByteView encoded) {
    for (const Signature& signature : signatures) {
        if (starts_with(encoded, signature.bytes)) return std::string(signature.format);
    }
    if (starts_with(encoded, "RIFF") && encoded.size() >= 12 && starts_with(encoded.subspan(8), "WEBP")) return "webp";
    return {};
}

std::string one_line(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text;
}

}  // namespace

bool is_ktx2(ByteView encoded) { return starts_with(encoded, "\xABKTX 20\xBB"); }

Image decode_image(ByteView encoded, std::uint32_t side_limit_pixels, std::uint64_t& pixel_bytes_left,
                   const std::string& place, StoredAs* stored) {
    const std::string format = format_of(encoded);
    if (format.empty()) refuse(place, "the image is not PNG, JPEG, WebP, HDR or EXR");
    if (format == "png") check_png(encoded, place);
    OIIO::Filesystem::IOMemReader memory(encoded.data(), encoded.size());
    OIIO::ImageSpec keep_as_stored;
    keep_as_stored.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    const std::string name = "image." + format;  // for OpenImageIO's own messages
    if (!input || !input->set_ioproxy(&memory) || !input->open(name, spec, keep_as_stored)) {
        refuse(place, "the image cannot be decoded (" + one_line(input ? input->geterror() : OIIO::geterror()) + ")");
    }
    input->threads(1);
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) refuse(place, "the image has no pixels");
    const auto width = static_cast<std::uint32_t>(spec.width), height = static_cast<std::uint32_t>(spec.height);
    if (width > side_limit_pixels || height > side_limit_pixels) {
        refuse(place, "the image is " + std::to_string(width) + "x" + std::to_string(height) +
                          " pixels; a side may have " + std::to_string(side_limit_pixels));
    }
    if (stored != nullptr) {
        *stored = {format, static_cast<int>(8 * spec.format.basesize()), spec.format.is_floating_point()};
    }
    const bool is_8_bit = spec.format == OIIO::TypeDesc::UINT8;
    const int channels = std::min(spec.nchannels, 4);
    const std::uint64_t numbers = std::uint64_t{width} * height * static_cast<std::uint64_t>(channels);
    const std::uint64_t bytes = numbers * (is_8_bit ? sizeof(std::uint8_t) : sizeof(float));
    if (bytes > pixel_bytes_left) refuse(place, "the images of the file have too many pixels together");
    pixel_bytes_left -= bytes;

    Image image;
    image.width = width;
    image.height = height;
    image.channels = static_cast<std::uint32_t>(channels);
    bool read = false;
    if (is_8_bit) {
        image.bytes.resize(numbers);
        read = input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, image.bytes.data());
    } else {
        image.floats.resize(numbers);
        read = input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, image.floats.data());
        // HDR and EXR can hold what no shader should meet.
        for (float& number : image.floats) {
            if (!std::isfinite(number)) number = 0;
        }
    }
    if (!read) refuse(place, "the image cannot be decoded (" + one_line(input->geterror()) + ")");
    return image;
}

Bytes encode_png(std::uint32_t width, std::uint32_t height, std::uint32_t channels, ByteView pixels) {
    Bytes bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("memory.png", &memory);
    if (!output) return {};
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels),
                         OIIO::TypeDesc::UINT8);
    spec.attribute("png:compressionLevel", 6);
    if (channels == 4) spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!output->open("memory.png", spec)) return {};
    if (!output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close()) return {};
    return bytes;
}

}  // namespace blush::load
