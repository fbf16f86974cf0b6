#pragma once
/// The loops of rig/deform/simd/kernels.h, for any width of vector.
///
/// Each file that includes this may be compiled for another instruction set. So all of it has internal linkage, and
/// nothing from a library that could be emitted as a shared inline function is used: the linker would keep one copy of
/// it for the whole program, perhaps the one that this machine cannot run.

#include <math.h>  // NOLINT(modernize-deprecated-headers): sqrtf(), which is not inline

#include "rig/deform/direction_limits.h"
#include "rig/deform/simd/kernels.h"

namespace blush::simd {
namespace {

/// One float as a vector of one: the scalar path, and what is left over at the end of the others.
struct Pack1 {
    static constexpr std::size_t width = 1;
    float v;
    using Mask = bool;
    static Pack1 all(float value) { return {value}; }
    static Pack1 load(const float* from) { return {*from}; }
    static Pack1 load(const std::int16_t* from) { return {static_cast<float>(*from)}; }
    void store(float* to) const { *to = v; }
    static void load3(const float* from, Pack1& x, Pack1& y, Pack1& z) { x.v = from[0], y.v = from[1], z.v = from[2]; }
    static void store3(float* to, Pack1 x, Pack1 y, Pack1 z) { to[0] = x.v, to[1] = y.v, to[2] = z.v; }
    static void load4(const float* from, Pack1& x, Pack1& y, Pack1& z, Pack1& w) {
        load3(from, x, y, z);
        w.v = from[3];
    }
    static void store4(float* to, Pack1 x, Pack1 y, Pack1 z, Pack1 w) {
        store3(to, x, y, z);
        to[3] = w.v;
    }
    friend Pack1 operator+(Pack1 a, Pack1 b) { return {a.v + b.v}; }
    friend Pack1 operator-(Pack1 a, Pack1 b) { return {a.v - b.v}; }
    friend Pack1 operator*(Pack1 a, Pack1 b) { return {a.v * b.v}; }
    friend Pack1 operator/(Pack1 a, Pack1 b) { return {a.v / b.v}; }
    static Pack1 root(Pack1 a) { return {sqrtf(a.v)}; }
    static Mask differ(Pack1 a, Pack1 b) { return !(a.v == b.v); }
    static Mask less(Pack1 a, Pack1 b) { return a.v < b.v; }
    static Mask both(Mask a, Mask b) { return a && b; }
    static Mask either(Mask a, Mask b) { return a || b; }
    static bool any(Mask mask) { return mask; }
    static Pack1 select(Mask mask, Pack1 yes, Pack1 no) { return mask ? yes : no; }
};

/// values[i] += weight * deltas[i] for `count` floats, in steps of Pack, then of Narrow, then one by one.
template <class Pack, class Narrow, class Delta>
inline void add_scaled(float* values, const Delta* deltas, std::size_t count, float weight) {
    std::size_t i = 0;
    const Pack wide_weight = Pack::all(weight);
    for (; i + Pack::width <= count; i += Pack::width) {
        (Pack::load(values + i) + wide_weight * Pack::load(deltas + i)).store(values + i);
    }
    if constexpr (Narrow::width < Pack::width) {
        const Narrow narrow_weight = Narrow::all(weight);
        for (; i + Narrow::width <= count; i += Narrow::width) {
            (Narrow::load(values + i) + narrow_weight * Narrow::load(deltas + i)).store(values + i);
        }
    }
    for (; i < count; ++i) values[i] += weight * Pack1::load(deltas + i).v;
}

template <class Pack, class Narrow, class Delta>
void add_piece(float* values, std::uint32_t components, TilePart part, const PieceView<Delta>& piece, float weight) {
    const Delta* deltas = piece.run_deltas;
    for (std::size_t r = 0; r < piece.run_count; ++r) {
        const std::uint32_t begin = piece.runs[r].first, count = piece.runs[r].count, end = begin + count;
        const std::uint32_t first = begin > part.first ? begin : part.first;
        const std::uint32_t last = end < part.last ? end : part.last;
        if (first < last) {
            add_scaled<Pack, Narrow>(values + std::size_t{components} * first,
                                     deltas + std::size_t{components} * (first - begin),
                                     std::size_t{components} * (last - first), weight);
        }
        deltas += std::size_t{components} * count;
    }
    deltas = piece.loose_deltas;
    for (std::size_t l = 0; l < piece.loose_count; ++l, deltas += components) {
        const std::uint32_t vertex = piece.loose[l];
        if (vertex < part.first || vertex >= part.last) continue;
        float* at = values + std::size_t{components} * vertex;
        at[0] += weight * Pack1::load(deltas).v;
        at[1] += weight * Pack1::load(deltas + 1).v;
        at[2] += weight * Pack1::load(deltas + 2).v;  // the fourth of a tangent is its sign, which no target moves
    }
}

template <class Pack>
struct Vectors {
    Pack x, y, z;
};

template <class Pack>
inline Pack dot3(const Vectors<Pack>& a, const Vectors<Pack>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// normalized_or() of rig/deform/surface_normals.h.
template <class Pack>
inline Vectors<Pack> normalized_or(const Vectors<Pack>& v, const Vectors<Pack>& fallback) {
    const Pack length2 = dot3(v, v);
    const auto has_direction =
        Pack::both(Pack::less(Pack::all(smallest_length2), length2), Pack::less(length2, Pack::all(largest_length2)));
    const Pack inverse = Pack::all(1.0F) / Pack::root(length2);
    return {Pack::select(has_direction, v.x * inverse, fallback.x),
            Pack::select(has_direction, v.y * inverse, fallback.y),
            Pack::select(has_direction, v.z * inverse, fallback.z)};
}

template <class Pack>
inline auto differ(const Vectors<Pack>& a, const Vectors<Pack>& b) {
    return Pack::either(Pack::either(Pack::differ(a.x, b.x), Pack::differ(a.y, b.y)), Pack::differ(a.z, b.z));
}

template <class Pack>
inline Vectors<Pack> select(typename Pack::Mask mask, const Vectors<Pack>& yes, const Vectors<Pack>& no) {
    return {Pack::select(mask, yes.x, no.x), Pack::select(mask, yes.y, no.y), Pack::select(mask, yes.z, no.z)};
}

/// Whole vectors of vertices from `from` on; returns the first vertex that is left over.
template <class Pack>
inline std::size_t finish_from(std::size_t from, float* normals, float* tangents, const float* rest_normals,
                               const float* rest_tangents, std::size_t count) {
    std::size_t i = from;
    for (; i + Pack::width <= count; i += Pack::width) {
        Vectors<Pack> normal, rest_normal, tangent, rest_tangent;
        Pack sign, rest_sign;
        Pack::load3(normals + 3 * i, normal.x, normal.y, normal.z);
        Pack::load3(rest_normals + 3 * i, rest_normal.x, rest_normal.y, rest_normal.z);
        Pack::load4(tangents + 4 * i, tangent.x, tangent.y, tangent.z, sign);
        Pack::load4(rest_tangents + 4 * i, rest_tangent.x, rest_tangent.y, rest_tangent.z, rest_sign);

        // What no target changed keeps its bits.
        const auto summed = differ(normal, rest_normal);
        const auto tangent_changed = differ(tangent, rest_tangent);
        if (!Pack::any(Pack::either(summed, tangent_changed))) continue;
        normal = select<Pack>(summed, normalized_or(normal, rest_normal), normal);
        const auto changed = Pack::either(differ(normal, rest_normal), tangent_changed);
        const Pack along = dot3(normal, tangent);
        const Vectors<Pack> across = {tangent.x - normal.x * along, tangent.y - normal.y * along,
                                      tangent.z - normal.z * along};
        tangent = select<Pack>(changed, normalized_or(across, rest_tangent), tangent);

        Pack::store3(normals + 3 * i, normal.x, normal.y, normal.z);
        Pack::store4(tangents + 4 * i, tangent.x, tangent.y, tangent.z, sign);
    }
    return i;
}

template <class Pack, class Narrow>
void finish_directions(float* normals, float* tangents, const float* rest_normals, const float* rest_tangents,
                       std::size_t count) {
    std::size_t i = finish_from<Pack>(0, normals, tangents, rest_normals, rest_tangents, count);
    if constexpr (Narrow::width < Pack::width) {
        i = finish_from<Narrow>(i, normals, tangents, rest_normals, rest_tangents, count);
    }
    if constexpr (Pack::width > 1) finish_from<Pack1>(i, normals, tangents, rest_normals, rest_tangents, count);
}

template <class Pack, class Narrow>
constexpr Kernels kernels_of() {
    return {add_piece<Pack, Narrow, float>, add_piece<Pack, Narrow, std::int16_t>, finish_directions<Pack, Narrow>};
}

}  // namespace
}  // namespace blush::simd
