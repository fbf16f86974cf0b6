#include "tools/blush/kernel_fit.h"

#include <ceres/ceres.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace blush::tool {
namespace {

constexpr int cell_points = 8;  // midpoints along a side of a cell; the cell at the centre takes what is left

/// The kernel's share between two distances of one side, delta included where the range begins at 0.
double share(const KernelShape& shape, glm::length_t channel, double from, double to) {
    const double scale = shape.width * (0.001 + shape.falloff[channel]);
    const double inside = base_profile_integral(to / scale) - base_profile_integral(from / scale);
    const double delta = from == 0 ? 0.5 * (1 - shape.strength[channel]) : 0;
    return shape.strength[channel] * inside + delta;
}

class Residuals : public ceres::CostFunction {
public:
    Residuals(const FitSamples& samples, double width, glm::length_t channel)
        : samples_(samples), width_(width), channel_(channel) {
        set_num_residuals(static_cast<int>(samples.cell_target.size()));
        mutable_parameter_block_sizes()->push_back(2);
    }
    bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
        const std::vector<double> here = shares(parameters[0][0], parameters[0][1]);
        write(here, residuals);
        if (jacobians == nullptr || jacobians[0] == nullptr) return true;
        constexpr double step = 1e-6;  // of values around 0.1 to 1
        for (int p = 0; p < 2; ++p) {
            const double t = parameters[0][0] + (p == 0 ? step : 0), f = parameters[0][1] + (p == 1 ? step : 0);
            const std::vector<double> there = shares(t, f);
            const std::size_t n = here.size();
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = 0; j < n; ++j) {
                    jacobians[0][(i * n + j) * 2 + static_cast<std::size_t>(p)] =
                        (there[i] * there[j] - here[i] * here[j]) / step;
                }
            }
        }
        return true;
    }

private:
    std::vector<double> shares(double strength, double falloff) const {
        KernelShape shape;
        shape.width = width_;
        shape.strength[channel_] = strength;
        shape.falloff[channel_] = falloff;
        std::vector<double> result;
        for (std::size_t i = 0; i + 1 < samples_.distances_mm.size(); ++i) {
            result.push_back(share(shape, channel_, samples_.distances_mm[i], samples_.distances_mm[i + 1]));
        }
        return result;
    }
    void write(const std::vector<double>& s, double* residuals) const {
        for (std::size_t i = 0; i < s.size(); ++i) {
            for (std::size_t j = 0; j < s.size(); ++j) {
                const std::size_t at = i * s.size() + j;
                residuals[at] = s[i] * s[j] - samples_.cell_target[at][channel_];
            }
        }
    }
    const FitSamples& samples_;
    double width_;
    glm::length_t channel_;
};

}  // namespace

FitSamples fit_samples(const std::function<glm::dvec3(double)>& profile, double range_mm, int steps) {
    FitSamples samples;
    for (int i = 0; i <= steps; ++i) {
        const double u = static_cast<double>(i) / steps;
        samples.distances_mm.push_back(range_mm * u * u);
    }
    // Total light of the quarter plane, by rings in the logarithm of the distance: cells at the centre are too coarse
    // for a narrow Gaussian, so the first one is the rest.
    glm::dvec3 total(0);
    constexpr int rings = 4000;
    const double low = std::log(1e-5), step = (std::log(100 * range_mm) - low) / rings;
    for (int i = 0; i < rings; ++i) {
        const double r = std::exp(low + (i + 0.5) * step);
        total += profile(r) * (0.5 * std::numbers::pi * r * r * step);
    }
    const auto n = static_cast<std::size_t>(steps);
    samples.cell_target.assign(n * n, glm::dvec3(0));
    glm::dvec3 outside_centre(0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            if (i == 0 && j == 0) continue;
            const double x0 = samples.distances_mm[i], x1 = samples.distances_mm[i + 1];
            const double y0 = samples.distances_mm[j], y1 = samples.distances_mm[j + 1];
            glm::dvec3 sum(0);
            for (int a = 0; a < cell_points; ++a) {
                for (int b = 0; b < cell_points; ++b) {
                    sum += profile(
                        std::hypot(x0 + (x1 - x0) * (a + 0.5) / cell_points, y0 + (y1 - y0) * (b + 0.5) / cell_points));
                }
            }
            samples.cell_target[i * n + j] = sum * ((x1 - x0) * (y1 - y0) / (cell_points * cell_points)) / total / 4.0;
            outside_centre += samples.cell_target[i * n + j];
        }
    }
    // What lies beyond the range is as far away as to be nobody's: it counts in the first cell's rest no more than the
    // kernel's own truncation does.
    glm::dvec3 beyond(0);
    const double far_low = std::log(range_mm), far_step = (std::log(100 * range_mm) - far_low) / rings;
    for (int i = 0; i < rings; ++i) {
        const double r = std::exp(far_low + (i + 0.5) * far_step);
        beyond += profile(r) * (0.5 * std::numbers::pi * r * r * far_step);
    }
    samples.cell_target[0] = glm::max(glm::dvec3(0.25) - outside_centre - beyond / total / 4.0, glm::dvec3(0));
    return samples;
}

glm::dvec3 fit_error(const FitSamples& samples, const KernelShape& shape) {
    glm::dvec3 error(0);
    const std::size_t n = samples.distances_mm.size() - 1;
    for (glm::length_t c = 0; c < 3; ++c) {
        std::vector<double> s;
        for (std::size_t i = 0; i < n; ++i) {
            s.push_back(share(shape, c, samples.distances_mm[i], samples.distances_mm[i + 1]));
        }
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                const double difference = s[i] * s[j] - samples.cell_target[i * n + j][c];
                error[c] += difference * difference;
            }
        }
    }
    return error;
}

KernelFit fit_kernel(const FitSamples& samples, double width) {
    KernelFit fit;
    fit.shape.width = width;
    fit.converged = true;
    for (glm::length_t c = 0; c < 3; ++c) {
        std::array<double, 2> parameters = {0.7, 0.2};
        ceres::Problem problem;
        problem.AddResidualBlock(new Residuals(samples, width, c), nullptr, parameters.data());  // the problem's own
        problem.SetParameterLowerBound(parameters.data(), 0, 0);
        problem.SetParameterUpperBound(parameters.data(), 0, 1);
        problem.SetParameterLowerBound(parameters.data(), 1, 0.01);
        problem.SetParameterUpperBound(parameters.data(), 1, 1);
        ceres::Solver::Options options;
        options.max_num_iterations = 200;
        options.function_tolerance = 1e-12;
        options.parameter_tolerance = 1e-10;
        options.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
        fit.shape.strength[c] = parameters[0];
        fit.shape.falloff[c] = parameters[1];
        fit.iterations += static_cast<int>(summary.iterations.size());
        fit.converged = fit.converged && summary.termination_type == ceres::CONVERGENCE;
    }
    fit.error = fit_error(samples, fit.shape);
    return fit;
}

std::vector<glm::dvec3> singular_energy(const FitSamples& samples, std::size_t count) {
    const auto n = static_cast<Eigen::Index>(samples.distances_mm.size() - 1);
    std::vector<glm::dvec3> result(std::min(count, static_cast<std::size_t>(n)), glm::dvec3(0));
    for (glm::length_t c = 0; c < 3; ++c) {
        Eigen::MatrixXd matrix(n, n);
        for (Eigen::Index i = 0; i < n; ++i) {
            for (Eigen::Index j = 0; j < n; ++j)
                matrix(i, j) = samples.cell_target[static_cast<std::size_t>(i * n + j)][c];
        }
        const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix).singularValues();
        const double energy = values.squaredNorm();
        for (std::size_t k = 0; k < result.size(); ++k) {
            const double value = values[static_cast<Eigen::Index>(k)];
            result[k][c] = energy > 0 ? value * value / energy : 0;
        }
    }
    return result;
}

}  // namespace blush::tool
