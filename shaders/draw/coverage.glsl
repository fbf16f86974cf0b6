// Which samples of a pixel a surface covers, where it is drawn forward.

#ifdef HAIR
// An edge of a cut-out strand covers a share of the samples, as a triangle's edge does: the cut-off stands in the middle
// of a step one pixel wide. Which samples goes round from pixel to pixel, so that overlapping strands do not always hide
// the same ones.
void cover_samples(float opacity) {
    gl_SampleMask[0] = (1 << max(gl_NumSamples, 1)) - 1;
    if (gl_NumSamples < 2 || alpha.x < 0.0) {
        if (opacity < alpha.x) discard;
        return;
    }
    float share = clamp((opacity - alpha.x) / max(fwidth(opacity), 1e-3) + 0.5, 0.0, 1.0);
    int count = int(share * float(gl_NumSamples) + 0.5);
    if (count == 0) discard;
    int turn = (int(gl_FragCoord.x) + 2 * int(gl_FragCoord.y)) % gl_NumSamples;
    int mask = ((1 << count) - 1) << turn;
    gl_SampleMask[0] = (mask | mask >> gl_NumSamples) & ((1 << gl_NumSamples) - 1);
}
#endif

// Discards what is cut out. The opacity that is left to blend with.
float covered(float opacity) {
#ifdef HAIR
    cover_samples(opacity);
    // Nothing is left of it in 8 bits: most of a card.
    if (alpha.y == 0.0 && opacity < 1.0 / 255.0) discard;
    if (opacity >= BLUSH_HAIR_CORE_OPACITY) return 1.0;
#else
    if (opacity < alpha.x) discard;
#endif
    return max(opacity, alpha.y);
}
