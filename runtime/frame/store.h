#pragma once
/// What effects and passes keep on something that lives longer than a frame (a device, a scene, a view, a model, a
/// character): one object for each type that is asked for.

#include <memory>
#include <typeindex>
#include <unordered_map>

namespace blush {

class Store {
public:
    /// Made when first asked for: `T` is the asker's own type.
    template <class T>
    T& get() {
        std::shared_ptr<void>& kept = kept_[std::type_index(typeid(T))];
        if (!kept) kept = std::make_shared<T>();
        return *static_cast<T*>(kept.get());
    }
    /// Null where it was not asked for yet.
    template <class T>
    const T* find() const {
        const auto found = kept_.find(std::type_index(typeid(T)));
        return found == kept_.end() ? nullptr : static_cast<const T*>(found->second.get());
    }
    template <class T>
    void forget() {
        kept_.erase(std::type_index(typeid(T)));
    }

private:
    std::unordered_map<std::type_index, std::shared_ptr<void>> kept_;
};

}  // namespace blush
