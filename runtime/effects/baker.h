#pragma once
/// What bakers have in common: their work is done before any frame, by `blush bake`. They stand in the registry for
/// their settings, studies and hard cases; no frame asks them anything.

#include "runtime/frame/effect.h"

namespace blush {

inline Variant baker_variant(std::string label, std::string work, bool is_default, std::function<void()> run,
                             std::function<Variant::Error()> error) {
    return {std::move(label), std::move(run), std::move(error), std::move(work), is_default};
}

}  // namespace blush
