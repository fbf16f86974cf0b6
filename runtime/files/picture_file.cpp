#include "runtime/files/picture_file.h"

#include <OpenImageIO/imageio.h>

#include "runtime/files/bad_file.h"
#include "runtime/files/image_file.h"
#include "runtime/files/output_file.h"

namespace blush {

Result<PictureFile> load_picture(const std::filesystem::path& path) {
    constexpr std::uint64_t largest_file_bytes = std::uint64_t{1} << 30, largest_pixel_bytes = std::uint64_t{1} << 32;
    constexpr std::uint32_t largest_side_pixels = 16'384;  // what GL 4.5 devices commonly draw to
    try {
        const load::Bytes bytes = load::read_file(path, largest_file_bytes, "");
        std::uint64_t pixel_bytes_left = largest_pixel_bytes;
        load::StoredAs stored;
        PictureFile picture;
        picture.image = load::decode_image(bytes, largest_side_pixels, pixel_bytes_left, "", &stored);
        picture.linear = stored.format == "exr" || stored.format == "hdr";
        picture.premultiplied_alpha = stored.format == "exr";
        if (!picture.image.bytes.empty()) {
            picture.depth = PictureDepth::bits_8;
        } else if (stored.is_float) {
            picture.depth = stored.channel_bits == 16 ? PictureDepth::half : PictureDepth::single;
        } else {
            picture.depth = PictureDepth::bits_16;
        }
        return picture;
    } catch (const load::BadFile& bad) {
        return Error{path.string() + ": " + (bad.place.empty() ? "" : bad.place + ": ") + bad.reason};
    } catch (const std::bad_alloc&) {
        return Error{path.string() + ": the picture does not fit into memory"};
    } catch (const std::exception& thrown) {
        return Error{path.string() + ": the picture cannot be read (" + thrown.what() + ")"};
    }
}

namespace {

OIIO::TypeDesc type_of(PictureDepth depth) {
    switch (depth) {
        case PictureDepth::bits_8:
            return OIIO::TypeDesc::UINT8;
        case PictureDepth::bits_16:
            return OIIO::TypeDesc::UINT16;
        case PictureDepth::half:
            return OIIO::TypeDesc::HALF;
        case PictureDepth::single:
            return OIIO::TypeDesc::FLOAT;
    }
    return OIIO::TypeDesc::FLOAT;
}

}  // namespace

namespace {

Error unknown_ending(const std::filesystem::path& path) {
    return Error{path.string() + ": no picture format is known by the ending \"" + path.extension().string() + "\""};
}

}  // namespace

Status can_write_picture(const std::filesystem::path& path) {
    if (!OIIO::ImageOutput::create(path.string())) return unknown_ending(path);
    // What would be written is refused, so that nothing is; only what is in the way before has a sentence.
    const Status tried = write_beside(path, [](const std::filesystem::path&) -> Status { return Error{}; });
    if (!tried.error().message.empty()) return tried.error();
    return Done{};
}

Status write_picture(const std::filesystem::path& path, const PictureFile& picture) {
    const Image& image = picture.image;
    const auto output = OIIO::ImageOutput::create(path.string());
    if (!output) return unknown_ending(path);
    return write_beside(path, [&](const std::filesystem::path& beside) -> Status {
        const bool has_alpha = image.channels == 2 || image.channels == 4;
        const bool drop_alpha = has_alpha && output->supports("alpha") == 0;
        const int channels = static_cast<int>(image.channels) - (drop_alpha ? 1 : 0);
        OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), channels,
                             type_of(picture.depth));
        if (has_alpha && !drop_alpha) spec.alpha_channel = channels - 1;
        spec.attribute("oiio:ColorSpace", picture.linear ? "Linear" : "sRGB");
        if (!picture.premultiplied_alpha) spec.attribute("oiio:UnassociatedAlpha", 1);
        // Without these two, the same picture written twice would differ.
        spec.attribute("DateTime", "");
        spec.attribute("Software", "blush");
        const auto refused = [&] { return Error{path.string() + ": cannot be written: " + output->geterror()}; };
        if (!output->open(beside.string(), spec)) return refused();
        const bool bytes = !image.bytes.empty();
        const auto pixel_bytes = static_cast<OIIO::stride_t>(image.channels * (bytes ? 1 : sizeof(float)));
        const bool written = bytes ? output->write_image(OIIO::TypeDesc::UINT8, image.bytes.data(), pixel_bytes)
                                   : output->write_image(OIIO::TypeDesc::FLOAT, image.floats.data(), pixel_bytes);
        if (!written || !output->close()) return refused();
        return Done{};
    });
}

}  // namespace blush
