#include "rig/blood/colour_difference.h"

#include <cmath>

namespace blush {
namespace {

constexpr double pi = 3.14159265358979323846;
double radians(double degrees) { return degrees * pi / 180; }
double degrees(double radians) { return radians * 180 / pi; }

/// CIE 15: the cube root with its linear foot.
double lab_f(double t) {
    constexpr double foot = 216.0 / 24389.0, slope = 24389.0 / 27.0;
    return t > foot ? std::cbrt(t) : (slope * t + 16) / 116;
}

double hue_degrees(double b, double a) {
    if (a == 0 && b == 0) return 0;
    const double hue = degrees(std::atan2(b, a));
    return hue < 0 ? hue + 360 : hue;
}

double pow7(double x) {
    const double cube = x * x * x;
    return cube * cube * x;
}

/// sqrt(C^7 / (C^7 + 25^7)): how much neutral colours are treated apart.
double chroma_share(double chroma) { return std::sqrt(pow7(chroma) / (pow7(chroma) + pow7(25))); }

}  // namespace

double srgb_from_linear(double linear) {
    const double size = std::abs(linear);
    const double encoded = size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055;
    return std::copysign(encoded, linear);
}

double linear_from_srgb(double encoded) {
    const double size = std::abs(encoded);
    const double linear = size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4);
    return std::copysign(linear, encoded);
}

glm::dvec3 lab_from_srgb_linear(const glm::dvec3& rgb) {
    // Rows of the sRGB matrix (IEC 61966-2-1), each divided by its sum, so that (1, 1, 1) is exactly white.
    const double x = (0.4124 * rgb.r + 0.3576 * rgb.g + 0.1805 * rgb.b) / (0.4124 + 0.3576 + 0.1805);
    const double y = 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
    const double z = (0.0193 * rgb.r + 0.1192 * rgb.g + 0.9505 * rgb.b) / (0.0193 + 0.1192 + 0.9505);
    return {116 * lab_f(y) - 16, 500 * (lab_f(x) - lab_f(y)), 200 * (lab_f(y) - lab_f(z))};
}

// Equation numbers are those of Sharma et al. 2005.
double ciede2000(const glm::dvec3& one, const glm::dvec3& two) {
    const double chroma = (std::hypot(one.y, one.z) + std::hypot(two.y, two.z)) / 2;  // (2), (3)
    const double stretch = 1.5 - 0.5 * chroma_share(chroma);                          // (4), (5)
    const double a1 = stretch * one.y, a2 = stretch * two.y;
    const double c1 = std::hypot(a1, one.z), c2 = std::hypot(a2, two.z);    // (6)
    const double h1 = hue_degrees(one.z, a1), h2 = hue_degrees(two.z, a2);  // (7)
    const bool neutral = c1 * c2 == 0;

    const double lightness_difference = two.x - one.x, chroma_difference = c2 - c1;  // (8), (9)
    double turn = h2 - h1;                                                           // (10)
    if (turn > 180) turn -= 360;
    if (turn < -180) turn += 360;
    const double hue_difference = neutral ? 0 : 2 * std::sqrt(c1 * c2) * std::sin(radians(turn / 2));  // (11)

    const double mean_lightness = (one.x + two.x) / 2, mean_chroma = (c1 + c2) / 2;  // (12), (13)
    double mean_hue = h1 + h2;                                                       // (14)
    if (!neutral) {
        if (std::abs(h1 - h2) > 180) mean_hue += mean_hue < 360 ? 360 : -360;
        mean_hue /= 2;
    }
    const double t = 1 - 0.17 * std::cos(radians(mean_hue - 30)) + 0.24 * std::cos(radians(2 * mean_hue)) +
                     0.32 * std::cos(radians(3 * mean_hue + 6)) - 0.20 * std::cos(radians(4 * mean_hue - 63));  // (15)
    const double bend = (mean_hue - 275) / 25;
    const double rotation = -std::sin(radians(60 * std::exp(-bend * bend))) * 2 * chroma_share(mean_chroma);  // (16-21)
    const double off_middle = (mean_lightness - 50) * (mean_lightness - 50);
    const double l = lightness_difference / (1 + 0.015 * off_middle / std::sqrt(20 + off_middle));  // (18)
    const double c = chroma_difference / (1 + 0.045 * mean_chroma);                                 // (19)
    const double h = hue_difference / (1 + 0.015 * mean_chroma * t);                                // (20)
    return std::sqrt(l * l + c * c + h * h + rotation * c * h);                                     // (22)
}

double ciede2000_of_srgb_linear(const glm::dvec3& a, const glm::dvec3& b) {
    return ciede2000(lab_from_srgb_linear(a), lab_from_srgb_linear(b));
}

}  // namespace blush
