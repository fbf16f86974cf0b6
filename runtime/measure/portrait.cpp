#include "runtime/measure/portrait.h"

#include <algorithm>
#include <cassert>

#include "runtime/frame/character_state.h"

namespace blush {

Result<Portrait> Portrait::load(const Device& device, const std::filesystem::path& path) {
    const Result<FaceAsset> asset = FaceAsset::load(path);
    if (!asset) return asset.error();
    return create(device, *asset);
}

Result<Portrait> Portrait::create(const Device& device, Face face, const std::optional<RigDescription>& description) {
    const Result<FaceAsset> asset = FaceAsset::create(std::move(face), description);
    if (!asset) return asset.error();
    return create(device, *asset);
}

Result<Portrait> Portrait::create(const Device& device, const FaceAsset& asset) {
    Result<Character> character = Character::create(device, asset);
    if (!character) return character.error();
    Result<Scene> scene = Scene::create(device);
    if (!scene) return scene.error();
    Result<View> view = View::create(device);
    if (!view) return view.error();
    if (Status added = scene->add(*character); !added) return added.error();
    return Portrait(*std::move(character), *std::move(scene), *std::move(view));
}

Status Portrait::set(std::string_view setting, std::string_view choice) {
    const Result<SettingOwner> owner = EffectSettings::owner_of(setting);
    if (!owner) return owner.error();
    switch (*owner) {
        case SettingOwner::character:
            return character_.set(setting, choice);
        case SettingOwner::scene:
            return scene_.set(setting, choice);
        case SettingOwner::view:
            break;
    }
    return view_.set(setting, choice);
}

void Portrait::show(const FaceAsset& asset) {
    Result<Character> other = Character::create(character_.state().device, asset);
    assert(other && "the same face fits the same device");
    if (!other) return;
    CharacterState& to = other->state();
    const CharacterState& from = character_.state();
    to.controls = from.controls;
    to.pose = from.pose;
    to.blood = from.blood;
    to.settings = from.settings;
    to.world_from_face = from.world_from_face;
    character_ = *std::move(other);
    [[maybe_unused]] const Status added = scene_.add(character_);
    assert(added && "of the same device");
}

void Portrait::set_appearance(FaceAppearance appearance) {
    show(character_.asset().with_appearance(std::move(appearance)));
}

void Portrait::set_occlusion(std::optional<OcclusionSet> occlusion) {
    show(character_.asset().with_occlusion(std::move(occlusion)));
}

}  // namespace blush
