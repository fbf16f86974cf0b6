#include "rig/wrinkles/wrinkle_maps.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "rig/deform/blend_shapes.h"
#include "rig/deform/rest_frame.h"
#include "rig/wrinkles/folds.h"
#include "rig/wrinkles/surface_strain.h"

namespace blush {
namespace {

using Field = std::vector<float>;

/// Compression is smoothed over about this distance: folds do not follow single triangles.
constexpr float smoothing_mm = 4;
/// Of a zone without a place, a source of a few shapes shows where it is; within about this distance of it, whole
/// expressions count too.
constexpr float reach_mm = 12;
constexpr std::size_t few_shapes = 3;
/// Folds of one forehead differ in depth: this much of it, over patches of about this size. By eye.
constexpr float depth_variation = 0.6F;
constexpr float patch_mm = 6;
/// Shares of a zone's full compression at which its mask begins and is full. Without a place, what an expression only
/// drags along must not fold; with one, that is kept out already, and folds go on until the skin rests.
struct MaskRange {
    float begins, full;
};
constexpr MaskRange anywhere = {0.3F, 1}, placed = {0.1F, 0.6F};
/// Skin that gets shorter by this part or less does not fold.
constexpr float least_compression = 0.01F;
/// Share of the shortening that goes into folds; the rest thickens the tissue. By eye: furrows of a forehead are then
/// 0.25 to 0.6 mm deep at 8 mm from one to the next.
constexpr float folded_share = 0.1F;

/// The surface at a texel, in the mesh's axes, millimetres.
struct Chart {
    glm::dvec3 along_u{0}, along_v{0};  ///< from one texel to the next
    glm::dvec3 normal{0, 0, 1}, tangent{1, 0, 0}, bitangent{0, 1, 0};
};

class Baker {
public:
    Baker(const Face& face, std::span<const std::uint8_t> skin, const WrinkleBake& settings,
          std::span<const WrinkleZoneField> places)
        : face_(face),
          settings_(settings),
          places_(places),
          raster_(rasterize_uv(face, skin, settings.uv_set, settings.map_side, settings.map_side)),
          nearest_(nearest_covered(raster_)),
          place_(weld(face.positions)) {}

    bool empty() const { return nearest_.empty(); }
    bool is_placed(std::size_t zone) const { return !places_.empty() && !places_[zone].share.values.empty(); }
    /// How far a texel lies in a zone's place.
    float share(std::size_t zone, std::size_t i) const { return is_placed(zone) ? places_[zone].share.values[i] : 1; }

    void make_charts() {
        charts_.resize(raster_.texels.size());
        std::vector<double> sizes;
        for (std::size_t i = 0; i < charts_.size(); ++i) {
            if (!raster_.covered(i)) continue;
            charts_[i] = chart_at(i);
            const double area = glm::length(glm::cross(charts_[i].along_u, charts_[i].along_v));
            if (area > 0) sizes.push_back(std::sqrt(area));
        }
        if (sizes.empty()) return;
        const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
        std::ranges::nth_element(sizes, middle);
        texel_mm_ = static_cast<float>(*middle);
    }

    /// Adds a source's compression to the total tensor, and to the fields of the zones that it wrinkles.
    void add_source(const WrinkleSource& source) {
        std::vector<ActiveTarget> active;
        find_active(source.target_weights, active);
        if (active.empty() || *std::ranges::max_element(source.zone_weights) <= 0) return;
        std::vector<glm::vec3> positions = face_.positions, normals = face_.normals;
        std::vector<glm::vec4> tangents = face_.tangents;
        add_targets(face_, active, positions, normals, tangents);
        const std::vector<Compression> compression = vertex_compression(face_, place_, positions);

        Field amounts(raster_.texels.size(), 0);
        for (std::size_t i = 0; i < amounts.size(); ++i) {
            if (!raster_.covered(i)) continue;
            const auto tensor = interpolate(compression, i);
            float strongest = 0;
            for (std::size_t zone = 0; zone < source.zone_weights.size(); ++zone)
                strongest = std::max(strongest, source.zone_weights[zone] * share(zone, i));
            total_[i] += tensor * static_cast<double>(strongest);
            amounts[i] = static_cast<float>(principal_compression(tensor, charts_[i].normal).amount);
        }
        amounts = smoothed(amounts, smoothing_mm);
        std::vector<Field>& fields = active.size() <= few_shapes ? local_ : expressions_;
        for (std::size_t zone = 0; zone < source.zone_weights.size(); ++zone) {
            const float weight = std::min(source.zone_weights[zone], 1.0F);
            if (weight <= 0) continue;
            fields[zone].resize(amounts.size(), 0);
            for (std::size_t i = 0; i < amounts.size(); ++i)
                fields[zone][i] = std::max(fields[zone][i], weight * amounts[i]);
        }
    }

    void begin(std::size_t zones) {
        total_.assign(raster_.texels.size(), Compression(0));
        local_.resize(zones);
        expressions_.resize(zones);
    }

    /// Compression of a zone: its local sources, and of whole expressions what lies in its place, or near to them.
    Field zone_field(std::size_t zone) const {
        Field field = local_[zone].empty() ? Field(raster_.texels.size(), 0) : local_[zone];
        const Field& expression = expressions_[zone];
        if (expression.empty()) return field;
        Field reach;
        if (!local_[zone].empty() && !is_placed(zone)) {
            reach = smoothed(local_[zone], reach_mm);
            const float most = std::max(*std::ranges::max_element(reach), 1e-9F);
            // Full down to half of the strongest, fading out below a tenth.
            for (float& value : reach) value = glm::smoothstep(0.1F, 0.5F, value / most);
        }
        for (std::size_t i = 0; i < field.size(); ++i)
            field[i] = std::max(field[i], expression[i] * (reach.empty() ? 1 : reach[i]));
        return field;
    }

    /// What counts as full compression of a zone: its 95th percentile where it is pressed at all.
    float full_compression(std::size_t zone, const Field& field) const {
        std::vector<float> pressed;
        for (std::size_t i = 0; i < field.size(); ++i) {
            if (field[i] > least_compression && share(zone, i) > 0.5F) pressed.push_back(field[i]);
        }
        if (pressed.empty()) return 0;
        const auto place = pressed.begin() + static_cast<std::ptrdiff_t>(pressed.size() * 95 / 100);
        std::ranges::nth_element(pressed, place);
        return *place;
    }

    void smooth_total() {
        for (int c = 0; c < 3; ++c) {
            for (int r = 0; r <= c; ++r) {
                Field component(total_.size());
                for (std::size_t i = 0; i < component.size(); ++i) component[i] = static_cast<float>(total_[i][c][r]);
                component = smoothed(component, smoothing_mm);
                for (std::size_t i = 0; i < component.size(); ++i)
                    total_[i][c][r] = total_[i][r][c] = static_cast<double>(component[i]);
            }
        }
    }

    /// Where a zone is a single crease, its profile: a valley along the line, the skin on the far side heaped up beside
    /// it.
    void crease(std::size_t zone, Field& folds) const {
        if (!is_placed(zone) || places_[zone].crease_mm.values.empty()) return;
        for (std::size_t i = 0; i < folds.size(); ++i) {
            if (share(zone, i) > 0)
                folds[i] = glm::mix(folds[i], creased(places_[zone].crease_mm.values[i]), share(zone, i));
        }
    }

    /// Folds stand across the direction in which the skin is pressed together.
    std::vector<glm::vec2> wave_vectors() const {
        std::vector<glm::vec2> wave(raster_.texels.size(), glm::vec2(0));
        for (std::size_t i = 0; i < wave.size(); ++i) {
            if (!raster_.covered(i)) continue;
            const PrincipalCompression principal = principal_compression(total_[i], charts_[i].normal);
            if (principal.amount <= static_cast<double>(least_compression)) continue;
            const glm::dvec3 cycles_a_mm = principal.direction / static_cast<double>(settings_.spacing_mm);
            wave[i] = {static_cast<float>(glm::dot(cycles_a_mm, charts_[i].along_u)),
                       static_cast<float>(glm::dot(cycles_a_mm, charts_[i].along_v))};
        }
        return wave;
    }

    /// Derivatives of a height field (mm) in the face's tangent space; texels outside of all charts repeat the nearest.
    DerivativeMap derivatives(const Field& heights) const {
        DerivativeMap map(settings_.map_side, settings_.map_side, glm::vec2(0));
        for (std::size_t i = 0; i < heights.size(); ++i) {
            if (!raster_.covered(i)) continue;
            const Chart& chart = charts_[i];
            const double uu = glm::dot(chart.along_u, chart.along_u), uv = glm::dot(chart.along_u, chart.along_v),
                         vv = glm::dot(chart.along_v, chart.along_v), determinant = uu * vv - uv * uv;
            if (!(determinant > 0)) continue;
            const double rise_u = rise(heights, i, 1, 0), rise_v = rise(heights, i, 0, 1);
            const glm::dvec3 gradient = chart.along_u * ((vv * rise_u - uv * rise_v) / determinant) +
                                        chart.along_v * ((uu * rise_v - uv * rise_u) / determinant);
            map.values[i] = {static_cast<float>(-glm::dot(gradient, chart.tangent)),
                             static_cast<float>(-glm::dot(gradient, chart.bitangent))};
        }
        for (std::size_t i = 0; i < heights.size(); ++i) map.values[i] = map.values[nearest_[i]];
        return map;
    }

    /// Means over the texels of a map of another size; texels outside of all charts repeat the nearest.
    Field resized(const Field& field, std::uint32_t side) const {
        Field result(std::size_t{side} * side);
        const std::uint32_t from = settings_.map_side;
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t left = x * from / side, right = std::max((x + 1) * from / side, left + 1);
                const std::uint32_t top = y * from / side, bottom = std::max((y + 1) * from / side, top + 1);
                float sum = 0;
                for (std::uint32_t v = top; v < bottom; ++v)
                    for (std::uint32_t u = left; u < right; ++u) sum += field[nearest_[std::size_t{v} * from + u]];
                result[std::size_t{y} * side + x] = sum / static_cast<float>((right - left) * (bottom - top));
            }
        }
        return result;
    }

    /// From 1 - depth_variation to 1, in smooth patches: white noise under a bell.
    Field depths() const {
        Field noise(raster_.texels.size());
        for (std::size_t i = 0; i < noise.size(); ++i)
            noise[i] = noise_at(static_cast<std::uint32_t>(i), settings_.seed + 1);
        noise = smoothed(noise, patch_mm);
        float most = 1e-9F;
        for (const float value : noise) most = std::max(most, std::abs(value));
        for (float& value : noise) value = 1 - depth_variation * (0.5F - 0.5F * value / most);
        return noise;
    }

    UvRaster take_raster() { return std::move(raster_); }

private:
    /// -1 on the line, up to 1 half a fold beyond it, 0 at a whole one; on the near side it only rises to 0.
    float creased(float side_mm) const {
        constexpr float two_pi = 6.28318531F;
        const float turn = std::min(std::abs(side_mm) / settings_.spacing_mm, 1.0F);
        if (side_mm < 0) return turn < 0.5F ? -0.5F - 0.5F * std::cos(two_pi * turn) : 0;
        return turn < 0.5F ? -std::cos(two_pi * turn) : 0.5F - 0.5F * std::cos(two_pi * turn);
    }

    Compression interpolate(const std::vector<Compression>& of_vertex, std::size_t i) const {
        const UvTexel& at = raster_.texels[i];
        const std::uint32_t* const corners = &face_.indices[std::size_t{at.triangle} * 3];
        Compression sum(0);
        for (std::size_t c = 0; c < 3; ++c)
            sum += of_vertex[corners[c]] * static_cast<double>(at.corner_weights[static_cast<int>(c)]);
        return sum;
    }

    Chart chart_at(std::size_t i) const {
        const std::span<const glm::vec2> uvs = settings_.uv_set == 1 ? face_.uv1 : face_.uv0;
        const std::uint32_t* const corners = &face_.indices[std::size_t{raster_.texels[i].triangle} * 3];
        std::array<glm::dvec3, 3> p;
        std::array<glm::dvec2, 3> uv;
        for (std::size_t c = 0; c < 3; ++c) {
            p[c] = glm::dvec3(face_.positions[corners[c]]) * static_cast<double>(settings_.millimetres_a_unit);
            uv[c] = glm::dvec2(uvs[corners[c]]) * static_cast<double>(settings_.map_side);
        }
        const glm::dvec2 uv1 = uv[1] - uv[0], uv2 = uv[2] - uv[0];
        const double area = uv1.x * uv2.y - uv2.x * uv1.y;
        Chart chart;
        if (area == 0) return chart;
        chart.along_u = ((p[1] - p[0]) * uv2.y - (p[2] - p[0]) * uv1.y) / area;
        chart.along_v = ((p[2] - p[0]) * uv1.x - (p[1] - p[0]) * uv2.x) / area;
        const glm::dvec3 n(raster_.interpolate<glm::vec3>(face_, i, face_.normals));
        const glm::vec4 t = raster_.interpolate<glm::vec4>(face_, i, face_.tangents);
        if (!(glm::dot(n, n) > 0)) return chart;
        chart.normal = glm::normalize(n);
        glm::dvec3 tangent(t);
        tangent -= chart.normal * glm::dot(chart.normal, tangent);
        if (!(glm::dot(tangent, tangent) > 0)) tangent = glm::dvec3(any_perpendicular(glm::vec3(chart.normal)));
        chart.tangent = glm::normalize(tangent);
        chart.bitangent = glm::cross(chart.normal, chart.tangent) * (t.w < 0 ? -1.0 : 1.0);
        return chart;
    }

    /// Difference of heights to the next texel, central where both neighbours lie on the surface.
    double rise(const Field& heights, std::size_t i, int dx, int dy) const {
        const auto side = static_cast<int>(settings_.map_side);
        const int x = static_cast<int>(i) % side, y = static_cast<int>(i) / side;
        const auto at = [&](int sign, double& steps) {
            const int nx = x + sign * dx, ny = y + sign * dy;
            const auto other = static_cast<std::size_t>(ny * side + nx);
            if (nx < 0 || ny < 0 || nx >= side || ny >= side || !raster_.covered(other)) return heights[i];
            steps += 1;
            return heights[other];
        };
        double steps = 0;
        const double ahead = static_cast<double>(at(1, steps)), behind = static_cast<double>(at(-1, steps));
        return steps > 0 ? (ahead - behind) / steps : 0;
    }

    /// Gaussian over the covered texels, with a standard deviation in millimetres.
    Field smoothed(const Field& field, float deviation_mm) const {
        const float deviation = std::min(deviation_mm / texel_mm_, static_cast<float>(settings_.map_side) / 4);
        const int radius = static_cast<int>(std::ceil(2.5F * deviation));
        if (radius == 0) return field;
        std::vector<float> bell;
        for (int d = -radius; d <= radius; ++d)
            bell.push_back(std::exp(-0.5F * static_cast<float>(d * d) / (deviation * deviation)));
        const auto side = static_cast<int>(settings_.map_side);
        Field values = field, covered(field.size()), sums(field.size()), weights(field.size());
        for (std::size_t i = 0; i < field.size(); ++i) covered[i] = raster_.covered(i) ? 1.0F : 0.0F;
        for (const bool across : {true, false}) {
            for (int y = 0; y < side; ++y) {
                for (int x = 0; x < side; ++x) {
                    const int along = across ? x : y;
                    float sum = 0, weight = 0;
                    for (int d = std::max(-radius, -along); d <= std::min(radius, side - 1 - along); ++d) {
                        const auto from = static_cast<std::size_t>(across ? y * side + x + d : (y + d) * side + x);
                        const float share = bell[static_cast<std::size_t>(d + radius)] * covered[from];
                        sum += share * values[from];
                        weight += share;
                    }
                    const auto i = static_cast<std::size_t>(y * side + x);
                    sums[i] = weight > 0 ? sum / weight : 0;
                    weights[i] = weight;
                }
            }
            values = sums;
            covered = weights;
        }
        for (std::size_t i = 0; i < field.size(); ++i) {
            if (!raster_.covered(i)) values[i] = 0;
        }
        return values;
    }

    const Face& face_;
    WrinkleBake settings_;
    std::span<const WrinkleZoneField> places_;
    UvRaster raster_;
    std::vector<std::uint32_t> nearest_, place_;
    std::vector<Chart> charts_;
    std::vector<Compression> total_;
    std::vector<Field> local_, expressions_;  // of each zone; empty: no source
    float texel_mm_ = 1;
};

}  // namespace

WrinkleMaps bake_wrinkles(const Face& face, std::span<const std::uint8_t> skin, std::span<const WrinkleSource> sources,
                          const WrinkleBake& settings, std::span<const WrinkleZoneField> places) {
    assert(!sources.empty() && settings.map_side > 0 && settings.mask_side > 0);
    assert(settings.spacing_mm > 0 && settings.millimetres_a_unit > 0);
    const std::size_t zones = sources[0].zone_weights.size();
    assert((places.empty() || places.size() == zones) && "one place for each zone, or none at all");
    Baker baker(face, skin, settings, places);
    const std::size_t map_texels = std::size_t{settings.map_side} * settings.map_side;
    WrinkleMaps maps;
    maps.displacement_mm = ScalarMap(settings.map_side, settings.map_side);
    maps.derivatives = DerivativeMap(settings.map_side, settings.map_side, glm::vec2(0));
    maps.masks.assign(zones, ScalarMap(settings.mask_side, settings.mask_side));
    if (baker.empty()) {
        maps.raster = baker.take_raster();
        return maps;
    }

    baker.make_charts();
    baker.begin(zones);
    for (const WrinkleSource& source : sources) baker.add_source(source);

    // Masks: compression relative to the zone's own fullest, and together no more than one.
    std::vector<Field> masks;
    std::vector<float> full;
    for (std::size_t zone = 0; zone < zones; ++zone) {
        masks.push_back(baker.zone_field(zone));
        full.push_back(baker.full_compression(zone, masks.back()));
        const MaskRange range = baker.is_placed(zone) ? placed : anywhere;
        for (std::size_t i = 0; i < map_texels; ++i) {
            float& value = masks.back()[i];
            value = full[zone] > 0
                        ? baker.share(zone, i) * glm::smoothstep(range.begins, range.full, value / full[zone])
                        : 0;
        }
    }
    Field compression(map_texels, 0);  // full compression of the zones that a texel belongs to
    for (std::size_t i = 0; i < map_texels; ++i) {
        float sum = 0;
        for (std::size_t zone = 0; zone < zones; ++zone) {
            sum += masks[zone][i];
            compression[i] += masks[zone][i] * full[zone];
        }
        if (sum <= 0) continue;
        compression[i] /= sum;
        for (std::size_t zone = 0; sum > 1 && zone < zones; ++zone) masks[zone][i] /= sum;
    }

    baker.smooth_total();
    Field folds = grow_folds(baker.wave_vectors(), settings.map_side, settings.map_side, settings.seed);
    for (std::size_t zone = 0; zone < zones; ++zone) baker.crease(zone, folds);
    const Field depths = baker.depths();
    for (std::size_t i = 0; i < map_texels; ++i) {
        // A sine of amplitude A and wavelength L is longer than its base by (pi A / L)^2, to second order: the length
        // that the skin has too much.
        constexpr float pi = 3.14159265F;
        const float amplitude = settings.spacing_mm / pi * std::sqrt(folded_share * compression[i]) * depths[i];
        // Valleys of skin are sharper than its ridges.
        const float depth = 0.5F - 0.5F * folds[i];
        maps.displacement_mm.values[i] = folds[i] == 0 ? 0 : amplitude * (1 - 2 * depth * depth);
    }
    maps.derivatives = baker.derivatives(maps.displacement_mm.values);
    for (std::size_t zone = 0; zone < zones; ++zone)
        maps.masks[zone].values = baker.resized(masks[zone], settings.mask_side);
    maps.raster = baker.take_raster();
    return maps;
}

}  // namespace blush
