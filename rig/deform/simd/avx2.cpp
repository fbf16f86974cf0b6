// Compiled with -mavx2 (rig/CMakeLists.txt) and called only where the processor has it. No -mfma: nothing is fused.
#include "rig/deform/simd/kernels.h"

#if BLUSH_X86
#include <immintrin.h>

#include "rig/deform/simd/pack4.h"

namespace blush::simd {
namespace {

/// Eight floats in an AVX register. What moves floats between vertices does so inside each half of four, as Pack4.
struct Pack8 {
    static constexpr std::size_t width = 8;
    __m256 v;
    struct Mask {
        __m256 v;
    };
    static Pack8 all(float value) { return {_mm256_set1_ps(value)}; }
    static Pack8 load(const float* from) { return {_mm256_loadu_ps(from)}; }
    static Pack8 load(const std::int16_t* from) {
        __m128i shorts;
        __builtin_memcpy(&shorts, from, sizeof shorts);
        return {_mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(shorts))};
    }
    void store(float* to) const { _mm256_storeu_ps(to, v); }

    /// Four floats into each half: from `low` and from `high`.
    static __m256 halves(const float* low, const float* high) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
    }
    static void store_halves(float* low, float* high, __m256 v) {
        _mm_storeu_ps(low, _mm256_castps256_ps128(v));
        _mm_storeu_ps(high, _mm256_extractf128_ps(v, 1));
    }
    static void load3(const float* from, Pack8& x, Pack8& y, Pack8& z) {
        const __m256 a = halves(from, from + 12), b = halves(from + 4, from + 16), c = halves(from + 8, from + 20);
        const __m256 x2_y2_x3_y3 = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
        const __m256 y0_z0_y1_z1 = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));
        x.v = _mm256_shuffle_ps(a, x2_y2_x3_y3, _MM_SHUFFLE(2, 0, 3, 0));
        y.v = _mm256_shuffle_ps(y0_z0_y1_z1, x2_y2_x3_y3, _MM_SHUFFLE(3, 1, 2, 0));
        z.v = _mm256_shuffle_ps(y0_z0_y1_z1, c, _MM_SHUFFLE(3, 0, 3, 1));
    }
    static void store3(float* to, Pack8 x, Pack8 y, Pack8 z) {
        const __m256 x0_y0_x1_y1 = _mm256_unpacklo_ps(x.v, y.v), x2_y2_x3_y3 = _mm256_unpackhi_ps(x.v, y.v);
        const __m256 z0_x1 = _mm256_shuffle_ps(z.v, x.v, _MM_SHUFFLE(1, 1, 0, 0));
        const __m256 y1_z1 = _mm256_shuffle_ps(y.v, z.v, _MM_SHUFFLE(1, 1, 1, 1));
        const __m256 z2_x3 = _mm256_shuffle_ps(z.v, x.v, _MM_SHUFFLE(3, 3, 2, 2));
        const __m256 y3_z3 = _mm256_shuffle_ps(y.v, z.v, _MM_SHUFFLE(3, 3, 3, 3));
        store_halves(to, to + 12, _mm256_shuffle_ps(x0_y0_x1_y1, z0_x1, _MM_SHUFFLE(2, 0, 1, 0)));
        store_halves(to + 4, to + 16, _mm256_shuffle_ps(y1_z1, x2_y2_x3_y3, _MM_SHUFFLE(1, 0, 2, 0)));
        store_halves(to + 8, to + 20, _mm256_shuffle_ps(z2_x3, y3_z3, _MM_SHUFFLE(2, 0, 2, 0)));
    }
    static void transpose(__m256& a, __m256& b, __m256& c, __m256& d) {
        const __m256 ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
        const __m256 cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
        a = _mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(1, 0, 1, 0));
        b = _mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(3, 2, 3, 2));
        c = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0));
        d = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2));
    }
    static void load4(const float* from, Pack8& x, Pack8& y, Pack8& z, Pack8& w) {
        x.v = halves(from, from + 16), y.v = halves(from + 4, from + 20);
        z.v = halves(from + 8, from + 24), w.v = halves(from + 12, from + 28);
        transpose(x.v, y.v, z.v, w.v);
    }
    static void store4(float* to, Pack8 x, Pack8 y, Pack8 z, Pack8 w) {
        transpose(x.v, y.v, z.v, w.v);
        store_halves(to, to + 16, x.v), store_halves(to + 4, to + 20, y.v);
        store_halves(to + 8, to + 24, z.v), store_halves(to + 12, to + 28, w.v);
    }

    friend Pack8 operator+(Pack8 a, Pack8 b) { return {_mm256_add_ps(a.v, b.v)}; }
    friend Pack8 operator-(Pack8 a, Pack8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
    friend Pack8 operator*(Pack8 a, Pack8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
    friend Pack8 operator/(Pack8 a, Pack8 b) { return {_mm256_div_ps(a.v, b.v)}; }
    static Pack8 root(Pack8 a) { return {_mm256_sqrt_ps(a.v)}; }
    static Mask differ(Pack8 a, Pack8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)}; }
    static Mask less(Pack8 a, Pack8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
    static Mask both(Mask a, Mask b) { return {_mm256_and_ps(a.v, b.v)}; }
    static Mask either(Mask a, Mask b) { return {_mm256_or_ps(a.v, b.v)}; }
    static bool any(Mask mask) { return _mm256_movemask_ps(mask.v) != 0; }
    static Pack8 select(Mask mask, Pack8 yes, Pack8 no) { return {_mm256_blendv_ps(no.v, yes.v, mask.v)}; }
};

}  // namespace

const Kernels avx2_kernels = kernels_of<Pack8, Pack4>();

}  // namespace blush::simd
#endif
