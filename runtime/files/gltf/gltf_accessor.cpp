#include "runtime/files/gltf/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "runtime/files/bad_file.h"

namespace blush::load {
namespace {

// Base attributes without any bytes (all zero) are allowed, but not in any number.
constexpr std::size_t most_elements_without_bytes = 1'000'000;

std::size_t component_bytes(int component_type, std::string_view place) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            refuse(place, "componentType " + std::to_string(component_type) + " is not one of glTF's");
    }
}

int components_of(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        case TINYGLTF_TYPE_MAT4:
            return 16;
        default:
            return 0;
    }
}

/// Elements in memory: `count` of them, the first byte of each `stride` after the one before.
struct Elements {
    ByteView bytes;
    std::size_t count = 0, stride = 0, component_size = 0;
    int component_type = 0, components = 0;
    bool normalized = false;

    template <class T>
    T component(std::size_t element, int component) const {
        T value;
        std::memcpy(&value, bytes.data() + element * stride + static_cast<std::size_t>(component) * component_size,
                    sizeof value);
        return value;
    }

    float number(std::size_t element, int c) const {
        switch (component_type) {
            case TINYGLTF_COMPONENT_TYPE_BYTE:
                return scaled(component<std::int8_t>(element, c));
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                return scaled(component<std::uint8_t>(element, c));
            case TINYGLTF_COMPONENT_TYPE_SHORT:
                return scaled(component<std::int16_t>(element, c));
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                return scaled(component<std::uint16_t>(element, c));
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                return scaled(component<std::uint32_t>(element, c));
            default:
                return component<float>(element, c);
        }
    }

    std::uint32_t whole_number(std::size_t element, int c) const {
        switch (component_size) {
            case 1:
                return component<std::uint8_t>(element, c);
            case 2:
                return component<std::uint16_t>(element, c);
            default:
                return component<std::uint32_t>(element, c);
        }
    }

private:
    template <class T>
    float scaled(T value) const {
        if (!normalized) return static_cast<float>(value);
        return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
    }
};

/// Checks that all of `elements` lie in the view from `offset` on, and points them at it.
void locate(Elements& elements, GltfDocument& document, std::size_t view, std::size_t offset, std::size_t stated_stride,
            std::string_view place) {
    const std::size_t element_size = elements.component_size * static_cast<std::size_t>(elements.components);
    elements.stride = stated_stride == 0 ? element_size : stated_stride;
    if (elements.stride < element_size) {
        refuse(place, "elements of " + std::to_string(element_size) + " bytes do not fit a byteStride of " +
                          std::to_string(elements.stride));
    }
    const ByteView bytes = document.buffers.view(view);
    if (elements.count == 0) return;
    const bool fits = offset <= bytes.size() && element_size <= bytes.size() - offset &&
                      elements.count - 1 <= (bytes.size() - offset - element_size) / elements.stride;
    if (!fits) {
        refuse(place, std::to_string(elements.count) + " elements of " + std::to_string(element_size) +
                          " bytes from byte " + std::to_string(offset) + " on do not fit the " +
                          std::to_string(bytes.size()) + " bytes of " + at("bufferViews", view));
    }
    elements.bytes = bytes.subspan(offset);
}

struct Accessor {
    std::size_t count = 0;
    std::optional<Elements> base;  ///< nothing: all zero
    struct Sparse {
        std::vector<std::uint32_t> elements;  ///< strictly ascending, below count
        Elements values;
    };
    std::optional<Sparse> sparse;
};

std::string name_of(std::size_t accessor, std::string_view place) {
    return std::string(place) + " (" + at("accessors", accessor) + ")";
}

Accessor open_accessor(GltfDocument& document, const AccessorUse& use) {
    const tinygltf::Accessor& source = document.model.accessors[use.accessor];
    const std::string place = name_of(use.accessor, use.place);
    if (components_of(source.type) != use.components) {
        refuse(place, "its type has " + std::to_string(components_of(source.type)) + " components, " +
                          std::to_string(use.components) + " are needed");
    }
    if (use.count && source.count != *use.count) {
        refuse(use.place, "it has " + std::to_string(source.count) + " elements, but " + std::to_string(*use.count) +
                              " are needed");
    }
    Elements elements;
    elements.count = source.count;
    elements.components = use.components;
    elements.component_type = source.componentType;
    elements.component_size = component_bytes(source.componentType, place);
    elements.normalized = source.normalized;

    Accessor accessor;
    accessor.count = source.count;
    if (source.bufferView >= 0) {
        const auto view = static_cast<std::size_t>(source.bufferView);
        accessor.base = elements;
        locate(*accessor.base, document, view, source.byteOffset, document.buffers.stride(view), place);
    } else if (!use.count && source.count > most_elements_without_bytes) {
        refuse(place, "it has no bufferView and says " + std::to_string(source.count) + " elements; at most " +
                          std::to_string(most_elements_without_bytes) + " are allowed without data");
    }
    if (source.sparse.isSparse) {
        const std::string inner = place + ".sparse";
        const auto count = static_cast<std::size_t>(source.sparse.count);
        if (count > source.count) {
            refuse(inner, "it replaces " + std::to_string(count) + " elements of " + std::to_string(source.count));
        }
        Elements indices;
        indices.count = count;
        indices.components = 1;
        indices.component_type = source.sparse.indices.componentType;
        indices.component_size = component_bytes(indices.component_type, inner + ".indices");
        if (indices.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
            indices.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
            indices.component_type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
            refuse(inner + ".indices", "they are not unsigned integers");
        }
        locate(indices, document, static_cast<std::size_t>(source.sparse.indices.bufferView),
               static_cast<std::size_t>(source.sparse.indices.byteOffset), 0, inner + ".indices");
        Accessor::Sparse sparse;
        sparse.values = elements;
        sparse.values.count = count;
        locate(sparse.values, document, static_cast<std::size_t>(source.sparse.values.bufferView),
               static_cast<std::size_t>(source.sparse.values.byteOffset), 0, inner + ".values");
        sparse.elements.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t element = indices.whole_number(i, 0);
            if (element >= source.count) {
                refuse(inner + ".indices", "element " + std::to_string(i) + " is " + std::to_string(element) +
                                               ", but the accessor has " + std::to_string(source.count) + " elements");
            }
            if (i > 0 && element <= sparse.elements.back())
                refuse(inner + ".indices", "they are not strictly ascending");
            sparse.elements.push_back(element);
        }
        accessor.sparse = std::move(sparse);
    }
    return accessor;
}

float finite_number(const Elements& elements, std::size_t element, int c, std::size_t shown_element,
                    std::string_view place) {
    const float value = elements.number(element, c);
    if (!std::isfinite(value)) refuse(place, "element " + std::to_string(shown_element) + " is not a finite number");
    return value;
}

glm::vec3 finite_vector(const Elements& elements, std::size_t element, std::size_t shown_element,
                        std::string_view place) {
    return {finite_number(elements, element, 0, shown_element, place),
            finite_number(elements, element, 1, shown_element, place),
            finite_number(elements, element, 2, shown_element, place)};
}

}  // namespace

std::size_t element_count(const GltfDocument& document, std::size_t accessor) {
    return document.model.accessors[accessor].count;
}

std::vector<float> read_floats(GltfDocument& document, const AccessorUse& use) {
    const Accessor accessor = open_accessor(document, use);
    const auto width = static_cast<std::size_t>(use.components);
    document.spend(accessor.count * width, use.place);
    std::vector<float> numbers(accessor.count * width);
    if (accessor.base) {
        for (std::size_t i = 0; i < accessor.count; ++i) {
            for (std::size_t c = 0; c < width; ++c) {
                numbers[i * width + c] = finite_number(*accessor.base, i, static_cast<int>(c), i, use.place);
            }
        }
    }
    if (accessor.sparse) {
        for (std::size_t i = 0; i < accessor.sparse->elements.size(); ++i) {
            const std::size_t element = accessor.sparse->elements[i];
            for (std::size_t c = 0; c < width; ++c) {
                numbers[element * width + c] =
                    finite_number(accessor.sparse->values, i, static_cast<int>(c), element, use.place);
            }
        }
    }
    return numbers;
}

SparseVectors read_sparse_vectors(GltfDocument& document, const AccessorUse& use) {
    const Accessor accessor = open_accessor(document, use);
    SparseVectors vectors;
    const auto keep = [&](std::size_t element, glm::vec3 value) {
        if (value == glm::vec3(0)) return;
        vectors.elements.push_back(static_cast<std::uint32_t>(element));
        vectors.values.push_back(value);
    };
    if (!accessor.base) {
        for (std::size_t i = 0; accessor.sparse && i < accessor.sparse->elements.size(); ++i) {
            const std::size_t element = accessor.sparse->elements[i];
            keep(element, finite_vector(accessor.sparse->values, i, element, use.place));
        }
    } else {
        document.spend(accessor.count, use.place);
        // Both lists ascend, so a replaced element is met when the dense walk arrives at it.
        std::size_t next = 0;
        for (std::size_t i = 0; i < accessor.count; ++i) {
            if (accessor.sparse && next < accessor.sparse->elements.size() && accessor.sparse->elements[next] == i) {
                keep(i, finite_vector(accessor.sparse->values, next++, i, use.place));
            } else {
                keep(i, finite_vector(*accessor.base, i, i, use.place));
            }
        }
    }
    document.spend(3 * vectors.elements.size(), use.place);
    return vectors;
}

std::vector<std::uint32_t> read_unsigned(GltfDocument& document, const AccessorUse& use) {
    const int type = document.model.accessors[use.accessor].componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        refuse(name_of(use.accessor, use.place), "its components are not unsigned integers");
    }
    const Accessor accessor = open_accessor(document, use);
    const auto width = static_cast<std::size_t>(use.components);
    document.spend(accessor.count * width, use.place);
    std::vector<std::uint32_t> numbers(accessor.count * width);
    const auto copy = [&](const Elements& from, std::size_t source, std::size_t element) {
        for (std::size_t c = 0; c < width; ++c)
            numbers[element * width + c] = from.whole_number(source, static_cast<int>(c));
    };
    for (std::size_t i = 0; accessor.base && i < accessor.count; ++i) copy(*accessor.base, i, i);
    for (std::size_t i = 0; accessor.sparse && i < accessor.sparse->elements.size(); ++i) {
        copy(accessor.sparse->values, i, accessor.sparse->elements[i]);
    }
    return numbers;
}

}  // namespace blush::load
