#pragma once
/// Four floats in an SSE2 register. Internal linkage: see rig/deform/simd/kernel_body.h.

#include <emmintrin.h>

#include "rig/deform/simd/kernel_body.h"

namespace blush::simd {
namespace {

struct Pack4 {
    static constexpr std::size_t width = 4;
    __m128 v;
    struct Mask {
        __m128 v;
    };
    static Pack4 all(float value) { return {_mm_set1_ps(value)}; }
    static Pack4 load(const float* from) { return {_mm_loadu_ps(from)}; }
    static Pack4 load(const std::int16_t* from) {
        const __m128i shorts = _mm_loadu_si64(from);
        // Each short into the upper half of an integer, then down again with its sign.
        return {_mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(shorts, shorts), 16))};
    }
    void store(float* to) const { _mm_storeu_ps(to, v); }

    /// Four vectors of three: x0 y0 z0 x1 | y1 z1 x2 y2 | z2 x3 y3 z3, as they lie in memory.
    static void load3(const float* from, Pack4& x, Pack4& y, Pack4& z) {
        const __m128 a = _mm_loadu_ps(from), b = _mm_loadu_ps(from + 4), c = _mm_loadu_ps(from + 8);
        const __m128 x2_y2_x3_y3 = _mm_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
        const __m128 y0_z0_y1_z1 = _mm_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));
        x.v = _mm_shuffle_ps(a, x2_y2_x3_y3, _MM_SHUFFLE(2, 0, 3, 0));
        y.v = _mm_shuffle_ps(y0_z0_y1_z1, x2_y2_x3_y3, _MM_SHUFFLE(3, 1, 2, 0));
        z.v = _mm_shuffle_ps(y0_z0_y1_z1, c, _MM_SHUFFLE(3, 0, 3, 1));
    }
    static void store3(float* to, Pack4 x, Pack4 y, Pack4 z) {
        const __m128 x0_y0_x1_y1 = _mm_unpacklo_ps(x.v, y.v), x2_y2_x3_y3 = _mm_unpackhi_ps(x.v, y.v);
        const __m128 z0_x1 = _mm_shuffle_ps(z.v, x.v, _MM_SHUFFLE(1, 1, 0, 0));
        const __m128 y1_z1 = _mm_shuffle_ps(y.v, z.v, _MM_SHUFFLE(1, 1, 1, 1));
        const __m128 z2_x3 = _mm_shuffle_ps(z.v, x.v, _MM_SHUFFLE(3, 3, 2, 2));
        const __m128 y3_z3 = _mm_shuffle_ps(y.v, z.v, _MM_SHUFFLE(3, 3, 3, 3));
        _mm_storeu_ps(to, _mm_shuffle_ps(x0_y0_x1_y1, z0_x1, _MM_SHUFFLE(2, 0, 1, 0)));
        _mm_storeu_ps(to + 4, _mm_shuffle_ps(y1_z1, x2_y2_x3_y3, _MM_SHUFFLE(1, 0, 2, 0)));
        _mm_storeu_ps(to + 8, _mm_shuffle_ps(z2_x3, y3_z3, _MM_SHUFFLE(2, 0, 2, 0)));
    }
    static void transpose(__m128& a, __m128& b, __m128& c, __m128& d) {
        const __m128 ab_low = _mm_unpacklo_ps(a, b), ab_high = _mm_unpackhi_ps(a, b);
        const __m128 cd_low = _mm_unpacklo_ps(c, d), cd_high = _mm_unpackhi_ps(c, d);
        a = _mm_movelh_ps(ab_low, cd_low);
        b = _mm_movehl_ps(cd_low, ab_low);
        c = _mm_movelh_ps(ab_high, cd_high);
        d = _mm_movehl_ps(cd_high, ab_high);
    }
    static void load4(const float* from, Pack4& x, Pack4& y, Pack4& z, Pack4& w) {
        x.v = _mm_loadu_ps(from), y.v = _mm_loadu_ps(from + 4);
        z.v = _mm_loadu_ps(from + 8), w.v = _mm_loadu_ps(from + 12);
        transpose(x.v, y.v, z.v, w.v);
    }
    static void store4(float* to, Pack4 x, Pack4 y, Pack4 z, Pack4 w) {
        transpose(x.v, y.v, z.v, w.v);
        _mm_storeu_ps(to, x.v), _mm_storeu_ps(to + 4, y.v);
        _mm_storeu_ps(to + 8, z.v), _mm_storeu_ps(to + 12, w.v);
    }

    friend Pack4 operator+(Pack4 a, Pack4 b) { return {_mm_add_ps(a.v, b.v)}; }
    friend Pack4 operator-(Pack4 a, Pack4 b) { return {_mm_sub_ps(a.v, b.v)}; }
    friend Pack4 operator*(Pack4 a, Pack4 b) { return {_mm_mul_ps(a.v, b.v)}; }
    friend Pack4 operator/(Pack4 a, Pack4 b) { return {_mm_div_ps(a.v, b.v)}; }
    static Pack4 root(Pack4 a) { return {_mm_sqrt_ps(a.v)}; }
    static Mask differ(Pack4 a, Pack4 b) { return {_mm_cmpneq_ps(a.v, b.v)}; }
    static Mask less(Pack4 a, Pack4 b) { return {_mm_cmplt_ps(a.v, b.v)}; }
    static Mask both(Mask a, Mask b) { return {_mm_and_ps(a.v, b.v)}; }
    static Mask either(Mask a, Mask b) { return {_mm_or_ps(a.v, b.v)}; }
    static bool any(Mask mask) { return _mm_movemask_ps(mask.v) != 0; }
    static Pack4 select(Mask mask, Pack4 yes, Pack4 no) {
        return {_mm_or_ps(_mm_and_ps(mask.v, yes.v), _mm_andnot_ps(mask.v, no.v))};
    }
};

}  // namespace
}  // namespace blush::simd
