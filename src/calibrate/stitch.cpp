// Stitching: a pose graph whose nodes are sheets and whose links are frames that show two of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>
#include <ceres/ceres.h>
#include <fmt/format.h>

#include "calibrate/seam_frames.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;

/// Of the whitened residual, beyond which a frame counts less.
constexpr double kRobust_sigmas = 3;

using Pose = std::array<double, 3>;

/// One frame's image centre on two sheets.
struct Link {
    SheetView first;
    SheetView second;
};

PlanePose plane_pose(const Pose& pose) {
    return {pose[0], pose[1], pose[2]};
}

/// The image centre by one sheet, less that by the other: place in mm, turn.
Eigen::Vector3d difference(const Link& link, const PlanePose& first, const PlanePose& second) {
    const PlanePose a = first * link.first.pose;
    const PlanePose b = second * link.second.pose;
    return {a.x - b.x, a.y - b.y, std::remainder(a.turn - b.turn, 2 * std::numbers::pi)};
}

/// The same, with the poses of the sheets as parameters, in standard deviations.
struct LinkResidual {
    PlanePose a;
    PlanePose b;
    Eigen::Matrix3d whitening;
    double turn_guess;  ///< takes whole turns off

    template <typename T>
    bool operator()(const T* first, const T* second, T* residual) const {
        using std::cos;
        using std::sin;
        const auto place = [](const T* sheet, const PlanePose& p) {
            const T c = cos(sheet[2]);
            const T s = sin(sheet[2]);
            return std::array<T, 2>{sheet[0] + c * p.x - s * p.y, sheet[1] + s * p.x + c * p.y};
        };
        const auto p = place(first, a);
        const auto q = place(second, b);
        const T off[3] = {p[0] - q[0], p[1] - q[1],
                          first[2] + a.turn - second[2] - b.turn - turn_guess};
        for (int i = 0; i < 3; ++i) {
            residual[i] = T(0);
            for (int j = 0; j < 3; ++j)
                residual[i] += whitening(i, j) * off[j];
        }
        return true;
    }
};

/// Covariance of a view, turned with its sheet.
Eigen::Matrix3d turned(const SheetView& view, const PlanePose& sheet) {
    const double c = std::cos(sheet.turn);
    const double s = std::sin(sheet.turn);
    Eigen::Matrix3d turn;
    turn << c, -s, 0, s, c, 0, 0, 0, 1;
    return turn * view.covariance * turn.transpose();
}

class Stitcher {
  public:
    Stitcher(std::size_t sheets, std::vector<Link> links, std::size_t fixed)
        : links_(std::move(links)), poses_(sheets), sigmas_(sheets), fixed_(fixed) {}

    void solve() {
        spread_from_fixed();
        ceres::Problem problem;
        for (const Link& link : links_) {
            if (!is_connected(link.first.sheet)) continue;
            add(problem, link);
        }
        problem.SetParameterBlockConstant(poses_[fixed_]->data());
        ceres::Solver::Options options;
        options.logging_type = ceres::SILENT;
        options.linear_solver_type = ceres::DENSE_QR;
        options.function_tolerance = 1e-12;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
        estimate_sigmas(problem, summary);
    }

    bool is_connected(std::size_t sheet) const { return poses_[sheet].has_value(); }
    /// In the frame of the fixed sheet; the sheet must be connected.
    PlanePose pose(std::size_t sheet) const { return plane_pose(*poses_[sheet]); }
    double sigma_mm(std::size_t sheet) const {
        return std::sqrt((sigmas_[sheet][0] + sigmas_[sheet][1]) / 2);
    }
    double sigma_rad(std::size_t sheet) const { return std::sqrt(sigmas_[sheet][2]); }
    const std::vector<Link>& links() const { return links_; }

  private:
    /// First poses, seam by seam: each by the frame that shows most of both.
    void spread_from_fixed() {
        poses_[fixed_] = Pose{};
        std::deque<std::size_t> open{fixed_};
        while (!open.empty()) {
            const std::size_t from = open.front();
            open.pop_front();
            std::map<std::size_t, std::pair<int, PlanePose>> best;
            for (const Link& link : links_) {
                for (const auto& [near, far] :
                     {std::pair(&link.first, &link.second), std::pair(&link.second, &link.first)}) {
                    if (near->sheet != from || is_connected(far->sheet)) continue;
                    const int dots = std::min(near->dots, far->dots);
                    auto& candidate = best[far->sheet];
                    if (dots <= candidate.first) continue;
                    candidate = {dots, pose(from) * near->pose * far->pose.inverse()};
                }
            }
            for (const auto& [sheet, candidate] : best) {
                const PlanePose& found = candidate.second;
                poses_[sheet] = Pose{found.x, found.y, found.turn};
                open.push_back(sheet);
            }
        }
    }

    void add(ceres::Problem& problem, const Link& link) {
        const PlanePose first = pose(link.first.sheet);
        const PlanePose second = pose(link.second.sheet);
        const Eigen::Matrix3d covariance = turned(link.first, first) + turned(link.second, second);
        const Eigen::Matrix3d lower = covariance.llt().matrixL();
        const double raw = first.turn + link.first.pose.turn - second.turn - link.second.pose.turn;
        const double turns = raw - std::remainder(raw, 2 * std::numbers::pi);
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<LinkResidual, 3, 3, 3>(
                new LinkResidual{link.first.pose, link.second.pose, lower.inverse(), turns}),
            new ceres::HuberLoss(kRobust_sigmas), poses_[link.first.sheet]->data(),
            poses_[link.second.sheet]->data());
    }

    /// From the residuals, as what frames say of themselves knows nothing of how sheets bend.
    void estimate_sigmas(ceres::Problem& problem, const ceres::Solver::Summary& summary) {
        const double freedom =
            std::max(summary.num_residuals_reduced - summary.num_parameters_reduced, 1);
        const double variance = 2 * summary.final_cost / freedom;
        ceres::Covariance::Options options;
        options.algorithm_type = ceres::DENSE_SVD;
        ceres::Covariance covariance(options);
        std::vector<std::pair<const double*, const double*>> blocks;
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            sigmas_[i].fill(i == fixed_ ? 0 : HUGE_VAL);
            if (poses_[i] && i != fixed_) blocks.emplace_back(poses_[i]->data(), poses_[i]->data());
        }
        if (!covariance.Compute(blocks, &problem)) return;
        for (std::size_t i = 0; i < poses_.size(); ++i) {
            if (!poses_[i] || i == fixed_) continue;
            std::array<double, 9> block{};
            covariance.GetCovarianceBlock(poses_[i]->data(), poses_[i]->data(), block.data());
            sigmas_[i] = {variance * block[0], variance * block[4], variance * block[8]};
        }
    }

    std::vector<Link> links_;
    std::vector<std::optional<Pose>> poses_;
    std::vector<Pose> sigmas_;  ///< variances
    std::size_t fixed_;
};

/// The one flip: the fixed sheet's y is down and its angles clockwise, the world's are not.
WorldPose world_of(const PlanePose& pose, const WorldPose& fixed) {
    const double c = std::cos(fixed.yaw_rad);
    const double s = std::sin(fixed.yaw_rad);
    const double right_m = pose.x / 1000;
    const double up_m = -pose.y / 1000;
    return {fixed.x_m + c * right_m - s * up_m, fixed.y_m + s * right_m + c * up_m,
            std::remainder(fixed.yaw_rad - pose.turn, 2 * std::numbers::pi)};
}

std::vector<Link> links_of(int frames, const FrameAt& frame_at,
                           const std::vector<SheetEntry>& sheets,
                           const std::optional<Camera>& camera, const CalibrateOptions& options,
                           Stitching& result) {
    SeamLocator locator(sheets, camera);
    std::vector<Link> links;
    for (int i = 0; i < frames; ++i) {
        const std::vector<SheetView> views = locator.views(frame_at(i));
        if (views.size() > 1) ++result.used;
        // Against the one that is seen best, so that no view counts for more than one link twice.
        const auto best = std::ranges::max_element(views, {}, &SheetView::dots);
        for (auto other = views.begin(); other != views.end(); ++other) {
            if (other != best) links.push_back({*best, *other});
        }
        if (options.progress && !options.progress(i + 1, frames)) {
            throw Error("stopped; nothing was written");
        }
    }
    return links;
}

void describe_seams(const Stitcher& stitcher, Stitching& result) {
    struct Sums {
        int frames = 0;
        double mm2 = 0;
        double rad2 = 0;
    };
    std::map<std::pair<std::size_t, std::size_t>, Sums> seams;
    for (const Link& link : stitcher.links()) {
        const std::size_t a = link.first.sheet;
        const std::size_t b = link.second.sheet;
        if (!stitcher.is_connected(a)) continue;
        const Eigen::Vector3d off = difference(link, stitcher.pose(a), stitcher.pose(b));
        Sums& sums = seams[std::minmax(a, b)];
        ++sums.frames;
        sums.mm2 += off.head<2>().squaredNorm() / 2;
        sums.rad2 += off[2] * off[2];
    }
    for (const auto& [pair, sums] : seams) {
        result.seams.push_back({result.sheets[pair.first].name, result.sheets[pair.second].name,
                                sums.frames, std::sqrt(sums.mm2 / sums.frames),
                                std::sqrt(sums.rad2 / sums.frames)});
    }
}

}  // namespace

Stitching stitch_sheets(int frames, const FrameAt& frame_at, std::vector<SheetEntry> sheets,
                        const std::optional<Camera>& camera, const CalibrateOptions& options) {
    if (sheets.size() < 2) throw Error("stitching needs a sheet file with at least two sheets");
    Stitching result;
    result.frames = frames;
    result.sheets = std::move(sheets);
    std::vector<Link> links = links_of(frames, frame_at, result.sheets, camera, options, result);
    if (links.empty()) {
        throw Error(
            fmt::format("none of the {} frames shows two sheets of the sheet file: drive "
                        "over the seams, and see that each sheet fills a third of the image "
                        "and shows 8 x 8 dots",
                        frames));
    }
    const auto has_world = std::ranges::find_if(
        result.sheets, [](const SheetEntry& entry) { return entry.world.has_value(); });
    std::size_t fixed = static_cast<std::size_t>(has_world - result.sheets.begin());
    if (has_world == result.sheets.end()) {
        fixed = result.sheets.size();
        for (const Link& link : links)
            fixed = std::min({fixed, link.first.sheet, link.second.sheet});
    }
    Stitcher stitcher(result.sheets.size(), std::move(links), fixed);
    stitcher.solve();
    const WorldPose origin = result.sheets[fixed].world.value_or(WorldPose{});
    for (std::size_t i = 0; i < result.sheets.size(); ++i) {
        SheetEntry& entry = result.sheets[i];
        if (!stitcher.is_connected(i)) {
            result.unconnected.push_back(entry.name);
            continue;
        }
        entry.world = world_of(stitcher.pose(i), origin);
        result.stitched.push_back(
            {entry.name, stitcher.sigma_mm(i), stitcher.sigma_rad(i), i == fixed});
    }
    describe_seams(stitcher, result);
    return result;
}

}  // namespace dotpose
