#pragma once
/// What an effect or a baker might break on. No GL.

#include <string_view>

namespace blush {

struct Face;
struct ViewFrame;

/// A scene in which it might break: changes a face and its controls before they are loaded and drawn, or baked.
struct HardCase {
    std::string_view name;
    std::string_view expectation;
    void (*make)(Face& face);
    /// Weight of every target of that face.
    float weight = 1;
    /// Changes what the frame is drawn for; may be null.
    void (*look)(ViewFrame& view) = nullptr;
};

}  // namespace blush
