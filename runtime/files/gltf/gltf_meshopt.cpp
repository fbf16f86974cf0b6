#include "runtime/files/gltf/gltf_meshopt.h"

#include <meshoptimizer.h>
#include <nlohmann/json.hpp>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

// The vertex codec stores 16 equal bytes of a channel in 2 bits, which is the most that any of the three codecs can do.
constexpr std::size_t largest_expansion = 64;

struct Layout {
    std::size_t count, stride;
    std::string mode, filter;
};

Layout layout_of(const nlohmann::json& extension) {
    return {extension["count"].get<std::size_t>(), extension["byteStride"].get<std::size_t>(),
            extension["mode"].get<std::string>(), extension.value("filter", "NONE")};
}

}  // namespace

std::size_t check_meshopt(const nlohmann::json& extension, std::size_t compressed_bytes, const std::string& place) {
    const auto [count, stride, mode, filter] = layout_of(extension);
    if (mode == "ATTRIBUTES") {
        if (stride == 0 || stride > 256 || stride % 4 != 0) {
            refuse(place + ".byteStride", "mode ATTRIBUTES needs a multiple of 4 from 4 to 256");
        }
    } else if (mode == "TRIANGLES" || mode == "INDICES") {
        if (stride != 2 && stride != 4) refuse(place + ".byteStride", "mode " + mode + " needs 2 or 4");
        if (mode == "TRIANGLES" && count % 3 != 0) refuse(place + ".count", "mode TRIANGLES needs a multiple of 3");
    } else {
        refuse(place + ".mode", "\"" + mode + "\" is not ATTRIBUTES, TRIANGLES or INDICES");
    }
    const bool filter_fits = filter == "NONE" || (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                             (filter == "QUATERNION" && stride == 8) || (filter == "EXPONENTIAL" && stride % 4 == 0);
    if (!filter_fits || (filter != "NONE" && mode != "ATTRIBUTES")) {
        refuse(place + ".filter",
               "\"" + filter + "\" does not go with mode " + mode + " and byteStride " + std::to_string(stride));
    }
    if (count > compressed_bytes * largest_expansion / stride) {
        refuse(place + ".count", std::to_string(compressed_bytes) + " bytes cannot hold " + std::to_string(count) +
                                     " elements of " + std::to_string(stride) + " bytes");
    }
    return count * stride;
}

Bytes decode_meshopt(const nlohmann::json& extension, ByteView compressed, const std::string& place) {
    const auto [count, stride, mode, filter] = layout_of(extension);
    Bytes decoded(count * stride);
    int failed = 0;
    if (mode == "ATTRIBUTES") {
        failed = meshopt_decodeVertexBuffer(decoded.data(), count, stride, compressed.data(), compressed.size());
    } else if (mode == "TRIANGLES") {
        failed = meshopt_decodeIndexBuffer(decoded.data(), count, stride, compressed.data(), compressed.size());
    } else {
        failed = meshopt_decodeIndexSequence(decoded.data(), count, stride, compressed.data(), compressed.size());
    }
    if (failed != 0) refuse(place, "the compressed bytes are not valid");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), count, stride);
    return decoded;
}

}  // namespace blush::load
