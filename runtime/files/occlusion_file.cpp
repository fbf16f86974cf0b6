#include "runtime/files/occlusion_file.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

#include "runtime/files/bad_file.h"
#include "runtime/files/bytes.h"
#include "runtime/files/output_file.h"

namespace blush {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "BLUSHOCC";
constexpr std::uint32_t version = 1;
constexpr float steps_of_one = 16384;  // no coefficient of a transfer exceeds 1.03
constexpr std::uint64_t most_file_bytes = 1ULL << 32;
constexpr std::uint32_t most_name_bytes = 4096;

class Writer {
public:
    void bytes(std::string_view text) { out_.append(text); }
    void number(std::uint64_t value, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) out_.push_back(static_cast<char>(value >> (8 * i) & 0xffU));
    }
    const std::string& text() const { return out_; }

private:
    std::string out_;
};

class Reader {
public:
    explicit Reader(load::ByteView bytes) : bytes_(bytes) {}
    std::string_view bytes(std::size_t count) {
        if (count > bytes_.size() - at_) load::refuse("", "the file ends too early");
        at_ += count;
        return {reinterpret_cast<const char*>(bytes_.data()) + at_ - count, count};
    }
    std::uint64_t number(std::size_t size) {
        std::uint64_t value = 0;
        const std::string_view text = bytes(size);
        for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{static_cast<unsigned char>(text[i])} << (8 * i);
        return value;
    }
    std::size_t left() const { return bytes_.size() - at_; }

private:
    load::ByteView bytes_;
    std::size_t at_ = 0;
};

OcclusionSet read_set(const fs::path& path, const Face& face) {
    const load::Bytes file = load::read_file(path, most_file_bytes, "");
    Reader reader(file);
    if (reader.left() < magic.size() || reader.bytes(magic.size()) != magic)
        load::refuse("", "this is not a file of occlusion coefficients");
    if (const std::uint64_t found = reader.number(4); found != version)
        load::refuse("", "its version is " + std::to_string(found) + "; version 1 is read");
    const std::uint64_t poses = reader.number(4), vertices = reader.number(4);
    reader.number(4);
    OcclusionSet set;
    set.face_identity = reader.number(8);
    if (poses == 0 || poses > most_occlusion_poses) {
        load::refuse("", "it has " + std::to_string(poses) + " poses; 1 to " + std::to_string(most_occlusion_poses) +
                             " are read");
    }
    if (vertices != face.positions.size() || set.face_identity != occlusion_identity(face)) {
        load::refuse(
            "", "it was made for another surface than that of " + face.path + "; blush bake occlusion makes it anew");
    }
    for (std::uint64_t p = 0; p < poses; ++p) {
        OcclusionPose pose;
        const std::uint64_t name_bytes = reader.number(4);
        if (name_bytes > most_name_bytes) load::refuse("", "the name of a pose is too long");
        pose.target = reader.bytes(name_bytes);
        if (pose.target.empty() != (p == 0)) load::refuse("", "its first pose alone must be rest, without a name");
        if (p > 0 && std::ranges::find(face.targets, pose.target, &Target::name) == face.targets.end())
            load::refuse("", "the face has no target \"" + pose.target + "\"");
        // Before memory is taken for what a header promises.
        if (reader.left() < vertices * 18) load::refuse("", "the file ends too early");
        pose.transfers.resize(vertices);
        for (LightTransfer& transfer : pose.transfers) {
            for (float& coefficient : transfer) {
                const auto stored = static_cast<std::int16_t>(static_cast<std::uint16_t>(reader.number(2)));
                coefficient = static_cast<float>(stored) / steps_of_one;
            }
        }
        set.poses.push_back(std::move(pose));
    }
    if (reader.left() != 0) load::refuse("", "bytes follow its last pose");
    return set;
}

}  // namespace

fs::path occlusion_path(const fs::path& face) {
    fs::path path = face;
    path.replace_extension(".occlusion");
    return path;
}

Status write_occlusion(const fs::path& path, const OcclusionSet& set) {
    Writer writer;
    writer.bytes(magic);
    writer.number(version, 4);
    writer.number(set.poses.size(), 4);
    writer.number(set.poses.empty() ? 0 : set.poses[0].transfers.size(), 4);
    writer.number(0, 4);
    writer.number(set.face_identity, 8);
    for (const OcclusionPose& pose : set.poses) {
        writer.number(pose.target.size(), 4);
        writer.bytes(pose.target);
        for (const LightTransfer& transfer : pose.transfers) {
            for (const float coefficient : transfer) {
                const auto stored = std::lround(std::clamp(coefficient * steps_of_one, -32767.0F, 32767.0F));
                writer.number(static_cast<std::uint16_t>(stored), 2);
            }
        }
    }
    return write_file(path, writer.text());
}

Result<OcclusionSet> load_occlusion(const fs::path& path, const Face& face) {
    const std::string name = path.string();
    try {
        return read_set(path, face);
    } catch (const load::BadFile& bad) {
        return Error{name + ": " + bad.reason};
    } catch (const std::bad_alloc&) {
        return Error{name + ": there is not enough memory to load this file"};
    } catch (const std::exception& error) {
        return Error{name + ": the file cannot be read (" + error.what() + ")"};
    }
}

Result<std::optional<OcclusionSet>> find_occlusion(const Face& face) {
    const fs::path path = occlusion_path(face.path);
    std::error_code failed;
    if (!fs::exists(path, failed)) return std::optional<OcclusionSet>();
    Result<OcclusionSet> set = load_occlusion(path, face);
    if (!set) return set.error();
    return std::optional<OcclusionSet>(*std::move(set));
}

}  // namespace blush
