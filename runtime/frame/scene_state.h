#pragma once
/// What a Scene holds: characters, their light, and what all views of it share.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "runtime/device.h"
#include "runtime/frame/store.h"
#include "runtime/lighting.h"
#include "runtime/settings.h"

namespace blush {

struct CharacterState;

struct SceneState {
    explicit SceneState(Device on) : device(std::move(on)) {}

    Device device;
    EffectSettings settings;
    std::optional<Lighting> lighting;  ///< none: a portrait's
    std::vector<std::weak_ptr<CharacterState>> members;
    std::uint64_t frame = 0;  ///< of the draw that goes on or was the last; counts from 1

    // The frame being drawn.
    std::vector<std::shared_ptr<CharacterState>> kept;  ///< while the draw goes on
    std::vector<CharacterState*> characters;
    bool surfaces_made = false;  ///< by a view of this frame
    Store store;

    template <class T>
    T& own() {
        return store.get<T>();
    }
};

}  // namespace blush
