#include "runtime/files/gltf/gltf_animation.h"

#include <algorithm>
#include <string>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/gltf_accessor.h"

namespace blush::load {
namespace {

Interpolation interpolation_of(const std::string& name, const std::string& place) {
    if (name == "STEP") return Interpolation::step;
    if (name == "LINEAR") return Interpolation::linear;
    if (name == "CUBICSPLINE") return Interpolation::cubic_spline;
    refuse(place + ".interpolation", "\"" + name + "\" is not STEP, LINEAR or CUBICSPLINE");
}

/// A sampler as a track of `width` floats a key, stored as `components` floats an element.
Track read_track(GltfDocument& document, const tinygltf::AnimationSampler& sampler, std::size_t width, int components,
                 const std::string& place) {
    Track track;
    track.interpolation = interpolation_of(sampler.interpolation, place);
    track.width = static_cast<std::uint32_t>(width);
    track.times_seconds = read_floats(document, {static_cast<std::size_t>(sampler.input), place + ".input", 1, {}});
    if (track.times_seconds.empty()) refuse(place + ".input", "an animation needs at least one key");
    for (std::size_t i = 1; i < track.times_seconds.size(); ++i) {
        if (!(track.times_seconds[i] > track.times_seconds[i - 1])) {
            refuse(place + ".input", "key " + std::to_string(i) + " is not later than the key before it");
        }
    }
    const std::size_t values_a_key = track.interpolation == Interpolation::cubic_spline ? 3 : 1;
    const std::size_t elements =
        track.times_seconds.size() * values_a_key * width / static_cast<std::size_t>(components);
    track.values =
        read_floats(document, {static_cast<std::size_t>(sampler.output), place + ".output", components, elements});
    return track;
}

/// A rotation of length zero cannot be interpolated. Tangents of a spline may be zero.
void check_rotations(const Track& track, const std::string& place) {
    const bool is_spline = track.interpolation == Interpolation::cubic_spline;
    for (std::size_t key = 0; key < track.times_seconds.size(); ++key) {
        const auto first = track.values.begin() + static_cast<std::ptrdiff_t>(4 * (is_spline ? 3 * key + 1 : key));
        if (std::all_of(first, first + 4, [](float x) { return x == 0; })) {
            refuse(place + ".output", "key " + std::to_string(key) + " is a rotation of length zero");
        }
    }
}

class AnimationReader {
public:
    AnimationReader(GltfDocument& document, const NodeOrder& order, const MeshTargets& mesh_targets)
        : document_(document), order_(order), mesh_targets_(mesh_targets), first_node_of_(mesh_targets.size(), -1) {
        for (std::size_t i = document.model.nodes.size(); i-- > 0;) {
            const int mesh = document.model.nodes[i].mesh;
            if (mesh >= 0) first_node_of_[static_cast<std::size_t>(mesh)] = static_cast<int>(i);
        }
    }

    Animation read(std::size_t index) {
        const tinygltf::Animation& source = document_.model.animations[index];
        const std::string place = at("animations", index);
        Animation animation;
        animation.name = source.name;
        for (std::size_t c = 0; c < source.channels.size(); ++c) {
            const std::string channel_place = place + "." + at("channels", c);
            const tinygltf::AnimationChannel& channel = source.channels[c];
            if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= source.samplers.size()) {
                refuse(channel_place + ".sampler", "there is no " +
                                                       at("samplers", static_cast<std::size_t>(channel.sampler)) +
                                                       ", the animation has " + std::to_string(source.samplers.size()));
            }
            if (channel.target_node < 0) {
                document_.notes.push_back(channel_place + ": it names no node and was left out");
                continue;
            }
            const std::string sampler_place = place + "." + at("samplers", static_cast<std::size_t>(channel.sampler));
            read_channel(channel, source.samplers[static_cast<std::size_t>(channel.sampler)], channel_place,
                         sampler_place, animation);
        }
        for (const NodeChannel& channel : animation.nodes) extend(animation, channel.track);
        for (const WeightChannel& channel : animation.weights) extend(animation, channel.track);
        return animation;
    }

private:
    static void extend(Animation& animation, const Track& track) {
        animation.duration_seconds = std::max(animation.duration_seconds, track.times_seconds.back());
    }

    void read_channel(const tinygltf::AnimationChannel& channel, const tinygltf::AnimationSampler& sampler,
                      const std::string& place, const std::string& sampler_place, Animation& animation) {
        const auto node = static_cast<std::size_t>(channel.target_node);
        const std::string& path = channel.target_path;
        if (path == "weights") return read_weights(node, sampler, place, sampler_place, animation);
        NodeChannel result;
        result.node = order_[node];
        int width = 3;
        if (path == "translation") {
            result.path = NodePath::translation;
        } else if (path == "rotation") {
            result.path = NodePath::rotation;
            width = 4;
        } else if (path == "scale") {
            result.path = NodePath::scale;
        } else {
            document_.notes.push_back(place + ": the path \"" + path + "\" is not understood and was left out");
            return;
        }
        result.track = read_track(document_, sampler, static_cast<std::size_t>(width), width, sampler_place);
        if (result.path == NodePath::rotation) check_rotations(result.track, sampler_place);
        animation.nodes.push_back(std::move(result));
    }

    void read_weights(std::size_t node, const tinygltf::AnimationSampler& sampler, const std::string& place,
                      const std::string& sampler_place, Animation& animation) {
        const int mesh = document_.model.nodes[node].mesh;
        if (mesh < 0 || mesh_targets_[static_cast<std::size_t>(mesh)].empty()) {
            document_.notes.push_back(place + ": it animates weights of a node without targets and was left out");
            return;
        }
        // Target weights belong to the face, not to a node, so two instances cannot differ.
        if (first_node_of_[static_cast<std::size_t>(mesh)] != channel_node(node)) {
            document_.notes.push_back(place + ": it animates a second instance of " +
                                      at("meshes", static_cast<std::size_t>(mesh)) + " and was left out");
            return;
        }
        WeightChannel result;
        result.targets = mesh_targets_[static_cast<std::size_t>(mesh)];
        result.track = read_track(document_, sampler, result.targets.size(), 1, sampler_place);
        animation.weights.push_back(std::move(result));
    }

    static int channel_node(std::size_t node) { return static_cast<int>(node); }

    GltfDocument& document_;
    const NodeOrder& order_;
    const MeshTargets& mesh_targets_;
    std::vector<int> first_node_of_;
};

}  // namespace

void read_animations(GltfDocument& document, const NodeOrder& order, const MeshTargets& mesh_targets, Face& face) {
    AnimationReader reader(document, order, mesh_targets);
    for (std::size_t i = 0; i < document.model.animations.size(); ++i) face.animations.push_back(reader.read(i));
}

}  // namespace blush::load
