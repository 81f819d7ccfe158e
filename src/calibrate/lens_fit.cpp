#include "calibrate/lens_fit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include <ceres/ceres.h>

#include "calibrate/median.hpp"
#include "calibrate/normal_inverse.hpp"

namespace dotpose::calibrate {
namespace {

constexpr int kLensRounds = 3;
constexpr double kOutlier_sigmas = 4;
/// Assumed standard deviation of the residuals before the first fit.
constexpr double kFirstSigma_px = 0.3;
/// Priors on the camera parameters: the distortion centre is near the image centre (standard
/// deviation 5 % of the image diagonal), the field of view is about 55 degrees, and pixels are
/// square to within 2 %. The priors only matter for parameters that the frames do not determine:
/// the distortion centre if there is no distortion, the focal length if the camera is not tilted,
/// and the shape of the pixels if the tilt never changes.
constexpr double kCentrePrior = 0.1;  // in units of half the image diagonal
constexpr double kReachPerFocal = 0.5;
constexpr double kReachPerFocalPrior = 0.5;
constexpr double kSquarePrior = 0.02;

/// A measured dot and the constants that its residual depends on.
struct Seen {
    double u;  ///< position relative to the image centre, in units of `reach_px`
    double v;
    double reach_px;
    double nominal_x;  ///< nominal position in mm, without the displacement
    double nominal_y;
    double displaced_x;  ///< offset of the dot in mm per unit of displacement
    double displaced_y;
    double mm_per_px;  ///< approximate scale

    /// Returns the undistorted position relative to the distortion centre, in px.
    template <typename T>
    std::array<T, 2> undistorted(const T* lens) const {
        const T x = u - lens[1] / reach_px;
        const T y = v - lens[2] / reach_px;
        const T stretch = reach_px / (1.0 + lens[0] * (x * x + y * y));  // paper, equation 2
        return {stretch * x, stretch * y};
    }
    /// Returns the printed position of the dot in the coordinate frame of the pose, in mm.
    template <typename T>
    std::array<T, 2> printed(const T& displacement, const T* pose) const {
        using std::cos;
        using std::sin;
        const T x = nominal_x + displacement * displaced_x - pose[0];
        const T y = nominal_y + displacement * displaced_y - pose[1];
        const T c = cos(pose[2]);
        const T s = sin(pose[2]);
        return {c * x + s * y, c * y - s * x};
    }
};

/// Residual for a mounted camera: the difference between the measured and the printed position of a
/// dot, in px.
struct MountedResidual {
    Seen seen;

    /// Returns the position on the paper, in mm. The origin is the point under the distortion
    /// centre, and the axes are the image axes at that point.
    template <typename T>
    std::array<T, 2> on_paper(const T* lens, const T* paper) const {
        const auto [a, b] = seen.undistorted(lens);
        const T divisor = 1.0 + (paper[3] * a + paper[4] * b) / seen.reach_px;
        return {paper[0] * (a + paper[2] * b) / divisor, paper[1] * b / divisor};
    }
    template <typename T>
    bool operator()(const T* lens, const T* paper, const T* displacement, const T* pose,
                    T* residual) const {
        const auto [x, y] = on_paper(lens, paper);
        const auto [printed_x, printed_y] = seen.printed(*displacement, pose);
        residual[0] = (x - printed_x) / seen.mm_per_px;
        residual[1] = (y - printed_y) / seen.mm_per_px;
        return true;
    }
};

/// Residual for a hand-held camera: the difference between the measured and the printed position of
/// a dot, in px. The camera model is that of simulate.hpp, extended to non-square pixels.
struct HandheldResidual {
    Seen seen;

    template <typename T>
    std::array<T, 2> on_paper(const T* lens, const T* shape, const T* pose) const {
        using std::cos;
        using std::sin;
        const auto [u, v] = seen.undistorted(lens);
        const T a = u + shape[2] * v;
        const T b = shape[1] * v;
        const T per_focal = shape[0] / seen.reach_px;
        const T cx = cos(pose[4]);
        const T sx = sin(pose[4]);
        const T cy = cos(pose[5]);
        const T sy = sin(pose[5]);
        // The point (s, t) on the paper is s (cy, sx sy, -cx sy) + t (0, cx, sx) + (0, 0, distance)
        // in the camera frame. Solves for the point at which the ray (a, b, focal) meets the paper.
        const T m00 = cy + a * per_focal * cx * sy;
        const T m01 = -a * per_focal * sx;
        const T m10 = sx * sy + b * per_focal * cx * sy;
        const T m11 = cx - b * per_focal * sx;
        const T factor = pose[3] / (m00 * m11 - m01 * m10);
        return {factor * (m11 * a - m01 * b), factor * (m00 * b - m10 * a)};
    }
    template <typename T>
    bool operator()(const T* lens, const T* shape, const T* displacement, const T* pose,
                    T* residual) const {
        const auto [x, y] = on_paper(lens, shape, pose);
        const auto [printed_x, printed_y] = seen.printed(*displacement, pose);
        residual[0] = (x - printed_x) / seen.mm_per_px;
        residual[1] = (y - printed_y) / seen.mm_per_px;
        return true;
    }
};

/// Residual of a prior: weight * (parameter[index] - expected).
template <int kSize>
struct Prior {
    int index;
    double expected;
    double weight;

    template <typename T>
    bool operator()(const T* parameters, T* residual) const {
        residual[0] = weight * (parameters[index] - expected);
        return true;
    }
};

template <int kSize>
void add_prior(ceres::Problem& problem, const Prior<kSize>& prior,
               std::array<double, kSize>& block) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Prior<kSize>, 1, kSize>(new Prior<kSize>(prior)), nullptr,
        block.data());
}

Seen seen_of(const LocatedDot& dot, const LocatedFrame& frame, const FitSetting& setting) {
    const double reach_px = setting.reach_px();
    const double mm = setting.spacing_mm;
    return {(dot.pixel.u - (setting.width_px - 1) / 2.0) / reach_px,
            (dot.pixel.v - (setting.height_px - 1) / 2.0) / reach_px,
            reach_px,
            dot.step.x * mm,
            dot.step.y * mm,
            dx(dot.symbol) * mm,
            dy(dot.symbol) * mm,
            mm / frame.spacing_px};
}

/// Returns the initial pose of a frame: the best-fitting similarity transform from undistorted px
/// to mm. The elements are position (2), rotation, mm per px, and two tilts of 0.
std::array<double, 6> first_pose(const LocatedFrame& frame, const FitSetting& setting,
                                 const SharedModel& camera) {
    using Complex = std::complex<double>;
    std::vector<std::array<Complex, 2>> pairs;
    std::array<Complex, 2> mean{};
    for (const LocatedDot& dot : frame.dots) {
        const Seen seen = seen_of(dot, frame, setting);
        const auto [a, b] = seen.undistorted(camera.lens.data());
        pairs.push_back({Complex(a, b), Complex(seen.nominal_x, seen.nominal_y)});
        for (std::size_t i = 0; i < 2; ++i)
            mean[i] += pairs.back()[i] / static_cast<double>(frame.dots.size());
    }
    Complex product = 0;
    double squares = 0;
    for (const auto& [image, paper] : pairs) {
        product += std::conj(image - mean[0]) * (paper - mean[1]);
        squares += std::norm(image - mean[0]);
    }
    const Complex map = product / squares;
    const Complex place = mean[1] - map * mean[0];
    return {place.real(), place.imag(), std::arg(map), std::abs(map), 0, 0};
}

void start_from_nothing(const std::vector<LocatedFrame>& frames, const FitSetting& setting,
                        LensFit& fit) {
    double mm_per_px = 0;
    for (const LocatedFrame& frame : frames) {
        fit.poses.push_back(first_pose(frame, setting, fit.camera));
        mm_per_px += fit.poses.back()[3] / static_cast<double>(frames.size());
    }
    fit.camera.paper = {mm_per_px, mm_per_px, 0, 0, 0};
    fit.camera.shape = {kReachPerFocal, 1, 0};
}

class Fitter {
  public:
    Fitter(const std::vector<LocatedFrame>& frames, const FitSetting& setting, LensFit& fit)
        : frames_(frames), setting_(setting), fit_(fit) {}

    void run() {
        double sigma_px = kFirstSigma_px;
        for (int round = 0; round < kLensRounds; ++round) {
            ceres::Problem problem;
            build(problem, round == 0, sigma_px);
            ceres::Solver::Options options;
            options.logging_type = ceres::SILENT;
            options.linear_solver_type = ceres::DENSE_SCHUR;
            options.max_num_iterations = 50;
            options.function_tolerance = 1e-9;
            ceres::Solver::Summary summary;
            ceres::Solve(options, &problem, &summary);
            evaluate();
            if (round == kLensRounds - 1) estimate_sigmas(problem);
            sigma_px = mark_outliers();
        }
    }

  private:
    void build(ceres::Problem& problem, bool is_first, double sigma_px) {
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            for (std::size_t k = 0; k < frames_[i].dots.size(); ++k) {
                if (!is_first && fit_.is_outlier[i][k]) continue;
                add(problem, seen_of(frames_[i].dots[k], frames_[i], setting_), fit_.poses[i],
                    is_first);
            }
        }
        if (fit_.stand == Stand::ideal) {
            problem.SetParameterBlockConstant(fit_.camera.lens.data());
            problem.SetManifold(fit_.camera.paper.data(), new ceres::SubsetManifold(5, {2, 3, 4}));
            return;
        }
        const double weight = sigma_px / (kCentrePrior * setting_.reach_px());
        add_prior<3>(problem, {1, 0, weight}, fit_.camera.lens);
        add_prior<3>(problem, {2, 0, weight}, fit_.camera.lens);
        if (fit_.stand == Stand::by_hand) {
            add_prior<3>(problem, {0, kReachPerFocal, sigma_px / kReachPerFocalPrior},
                         fit_.camera.shape);
            add_prior<3>(problem, {1, 1, sigma_px / kSquarePrior}, fit_.camera.shape);
            add_prior<3>(problem, {2, 0, sigma_px / kSquarePrior}, fit_.camera.shape);
        }
    }

    void add(ceres::Problem& problem, const Seen& seen, std::array<double, 6>& pose,
             bool is_robust) {
        SharedModel& c = fit_.camera;
        ceres::LossFunction* loss = is_robust ? new ceres::HuberLoss(1) : nullptr;
        if (fit_.stand == Stand::by_hand) {
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<HandheldResidual, 2, 3, 3, 1, 6>(
                    new HandheldResidual{seen}),
                loss, c.lens.data(), c.shape.data(), &c.displacement, pose.data());
        } else {
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<MountedResidual, 2, 3, 5, 1, 3>(
                    new MountedResidual{seen}),
                loss, c.lens.data(), c.paper.data(), &c.displacement, pose.data());
        }
    }

    /// Sets the residuals, their sum of squares, and the numbers of dots and parameters.
    void evaluate() {
        const SharedModel& c = fit_.camera;
        fit_.squares_px2 = 0;
        fit_.dots = 0;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            for (std::size_t k = 0; k < frames_[i].dots.size(); ++k) {
                const Seen seen = seen_of(frames_[i].dots[k], frames_[i], setting_);
                auto& residual = fit_.residuals_px[i][k];
                const double* pose = fit_.poses[i].data();
                if (fit_.stand == Stand::by_hand) {
                    HandheldResidual{seen}(c.lens.data(), c.shape.data(), &c.displacement, pose,
                                           residual.data());
                } else {
                    MountedResidual{seen}(c.lens.data(), c.paper.data(), &c.displacement, pose,
                                          residual.data());
                }
                if (fit_.is_outlier[i][k]) continue;
                fit_.squares_px2 += residual[0] * residual[0] + residual[1] * residual[1];
                ++fit_.dots;
            }
        }
        const int shared = fit_.stand == Stand::ideal ? 3 : fit_.stand == Stand::mounted ? 9 : 7;
        const int per_frame = fit_.stand == Stand::by_hand ? 6 : 3;
        fit_.parameters = shared + per_frame * static_cast<int>(frames_.size());
        const int freedom = std::max(2 * fit_.dots - fit_.parameters, 1);
        fit_.residual_px = std::sqrt(fit_.squares_px2 / freedom);
    }

    /// Marks the outliers. Returns the standard deviation of the residuals, in px.
    double mark_outliers() {
        std::vector<double> squares;
        for (const auto& frame : fit_.residuals_px) {
            for (const auto& [du, dv] : frame)
                squares.push_back(du * du + dv * dv);
        }
        const double variance = upper_median(std::move(squares)) / kMedianOfSquaredLength;
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            for (std::size_t k = 0; k < frames_[i].dots.size(); ++k) {
                const auto& [du, dv] = fit_.residuals_px[i][k];
                fit_.is_outlier[i][k] =
                    du * du + dv * dv > kOutlier_sigmas * kOutlier_sigmas * variance;
            }
        }
        return std::sqrt(variance);
    }

    void estimate_sigmas(ceres::Problem& problem) {
        SharedModel& c = fit_.camera;
        if (fit_.stand == Stand::ideal) return;
        const bool by_hand = fit_.stand == Stand::by_hand;
        const std::vector<double*> shared = {
            c.lens.data(), by_hand ? c.shape.data() : c.paper.data(), &c.displacement};
        const Eigen::MatrixXd covariance =
            fit_.residual_px * fit_.residual_px * normal_inverse(problem, shared);
        const auto sigma = [&](Eigen::Index i) { return std::sqrt(covariance(i, i)); };
        for (Eigen::Index i = 0; i < 3; ++i) {
            fit_.sigma.lens[static_cast<std::size_t>(i)] = sigma(i);
            if (by_hand) fit_.sigma.shape[static_cast<std::size_t>(i)] = sigma(3 + i);
        }
        if (by_hand) return;
        fit_.mounted_covariance = covariance.topLeftCorner(8, 8);
        for (Eigen::Index i = 0; i < 5; ++i)
            fit_.sigma.paper[static_cast<std::size_t>(i)] = sigma(3 + i);
    }

    const std::vector<LocatedFrame>& frames_;
    const FitSetting& setting_;
    LensFit& fit_;
};

}  // namespace

double FitSetting::reach_px() const {
    return std::hypot(width_px, height_px) / 2;
}

LensFit fit_lens(const std::vector<LocatedFrame>& frames, const FitSetting& setting, Stand stand,
                 const LensFit* start) {
    LensFit fit;
    if (start != nullptr) fit = *start;
    fit.stand = stand;
    if (fit.poses.size() != frames.size()) {
        fit.poses.clear();
        start_from_nothing(frames, setting, fit);
    }
    fit.residuals_px.clear();
    fit.is_outlier.clear();
    for (const LocatedFrame& frame : frames) {
        fit.residuals_px.emplace_back(frame.dots.size());
        fit.is_outlier.emplace_back(frame.dots.size(), 0);
    }
    Fitter(frames, setting, fit).run();
    return fit;
}

std::array<double, 2> place_on_paper(const LensFit& fit, std::size_t frame, PixelPoint pixel,
                                     const FitSetting& setting) {
    Seen seen{};
    seen.reach_px = setting.reach_px();
    seen.u = (pixel.u - (setting.width_px - 1) / 2.0) / seen.reach_px;
    seen.v = (pixel.v - (setting.height_px - 1) / 2.0) / seen.reach_px;
    const auto& pose = fit.poses[frame];
    const SharedModel& c = fit.camera;
    const auto [x, y] =
        fit.stand == Stand::by_hand
            ? HandheldResidual{seen}.on_paper(c.lens.data(), c.shape.data(), pose.data())
            : MountedResidual{seen}.on_paper(c.lens.data(), c.paper.data());
    const double cosine = std::cos(pose[2]);
    const double sine = std::sin(pose[2]);
    return {pose[0] + cosine * x - sine * y, pose[1] + sine * x + cosine * y};
}

}  // namespace dotpose::calibrate
