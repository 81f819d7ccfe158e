#include "calibrate/map_system.hpp"

#include <algorithm>
#include <cmath>

#include "calibrate/map_geometry.hpp"
#include "calibrate/map_parts.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

constexpr int kMaxIterations = 400;

}  // namespace

double MapUnknowns::inner(const MapUnknowns& other) const {
    double sum = camera.dot(other.camera);
    for (std::size_t i = 0; i < frames.size(); ++i)
        sum += frames[i].dot(other.frames[i]);
    for (std::size_t i = 0; i < field.size(); ++i)
        sum += field[i].dot(other.field[i]);
    return sum;
}

void MapUnknowns::combine(double scale, double by, const MapUnknowns& other) {
    camera = scale * camera + by * other.camera;
    for (std::size_t i = 0; i < frames.size(); ++i)
        frames[i] = scale * frames[i] + by * other.frames[i];
    for (std::size_t i = 0; i < field.size(); ++i)
        field[i] = scale * field[i] + by * other.field[i];
}

MapSystem::MapSystem(const MapGrid& grid, const EarlierOffsets& earlier,
                     const std::vector<MapObservation>& observations, const MapSolution& solution)
    : grid_(grid),
      earlier_(earlier),
      observations_(observations),
      solution_(solution),
      weight_(1 / (solution.noise_mm * solution.noise_mm)),
      prior_weight_(1 / (solution.jitter_mm * solution.jitter_mm)),
      information_(grid.dots(), prior_weight_),
      offsets_(grid.dots(), Vector2d::Zero()),
      sums_(kMapParts, std::vector<Vector2d>(grid.dots())),
      deformation_(grid, earlier, observations, solution) {
    for (std::size_t i = 0; i < grid.dots(); ++i) {
        const double earlier_views =
            earlier.views.empty() ? 0 : static_cast<double>(earlier.views[i]);
        information_[i] += weight_ * (solution.views[i] + earlier_views);
    }
    make_preconditioner();
}

MapUnknowns MapSystem::zeros() const {
    return {std::vector<FrameVector>(solution_.frames.size(), FrameVector::Zero()),
            CameraVector::Zero(), std::vector<Vector2d>(field_diagonal_.size(), Vector2d::Zero())};
}

MapUnknowns MapSystem::unknowns_of(const MapSolution& solution) const {
    MapUnknowns at = zeros();
    for (std::size_t i = 0; i < at.frames.size(); ++i)
        at.frames[i].tail<kViewTerms>() = solution.frames[i].view;
    at.camera = solution.camera;
    MapField field = solution.field;
    at.field = field.values();
    return at;
}

void MapSystem::eliminate(const MapUnknowns& at, Residuals residuals) {
    for_each_part([&](int part) {
        std::ranges::fill(sums_[static_cast<std::size_t>(part)], Vector2d::Zero());
    });
    const auto& frames = solution_.frames;
    for_each_item(frames.size(), [&](int part, std::size_t f) {
        auto& sums = sums_[static_cast<std::size_t>(part)];
        const MapView view(grid_, frames[f], solution_.reach_mm);
        const CameraVector shared = shared_terms(at.frames[f], at.camera);
        for (std::size_t k = 0; k < frames[f].count; ++k) {
            const MapObservation& seen = observations_[frames[f].first + k];
            if (seen.is_outlier()) continue;
            Vector2d change = view.terms(seen).change(at.frames[f], shared);
            if (residuals == Residuals::add) change += view.residual(seen);
            sums[seen.dot] += view.page_from_camera() * change;
        }
    });
    MapField field = solution_.field;
    field.values() = at.field;
    const bool has_earlier = residuals == Residuals::add && !earlier_.views.empty();
    for_each_item(grid_.dots(), [&](int, std::size_t i) {
        Vector2d sum = Vector2d::Zero();
        for (const auto& sums : sums_)
            sum += sums[i];
        if (has_earlier)
            sum += static_cast<double>(earlier_.views[i]) * earlier_.offset_mm[i].cast<double>();
        const auto [column, row] = grid_.cell_of(i);
        const Vector2d mean = field.at(column, row);
        offsets_[i] = (weight_ * sum + prior_weight_ * mean) / information_[i];
    });
}

void MapSystem::add_frames(const MapUnknowns& at, Residuals residuals, MapUnknowns& result) const {
    std::array<CameraVector, kMapParts> camera;
    camera.fill(CameraVector::Zero());
    const auto& frames = solution_.frames;
    for_each_item(frames.size(), [&](int part, std::size_t f) {
        CameraVector& camera_sum = camera[static_cast<std::size_t>(part)];
        const MapView view(grid_, frames[f], solution_.reach_mm);
        const CameraVector shared = shared_terms(at.frames[f], at.camera);
        FrameVector sum = FrameVector::Zero();
        double distortion = 0;
        for (std::size_t k = 0; k < frames[f].count; ++k) {
            const MapObservation& seen = observations_[frames[f].first + k];
            if (seen.is_outlier()) continue;
            const MapView::Terms terms = view.terms(seen);
            Vector2d left = terms.change(at.frames[f], shared) -
                            view.page_from_camera().transpose() * offsets_[seen.dot];
            if (residuals == Residuals::add) left += view.residual(seen);
            terms.add_transposed(left, sum, distortion);
        }
        sum *= weight_;
        camera_sum.head<kViewTerms>() += sum.tail<kViewTerms>();
        camera_sum[kViewTerms] += weight_ * distortion;
        for (int k = 0; k < kViewTerms; ++k) {
            const double sigma = solution_.view_sigma[static_cast<std::size_t>(k)];
            sum[4 + k] += at.frames[f][4 + k] / (sigma * sigma);
        }
        result.frames[f] = sum;
    });
    for (const CameraVector& sum : camera)
        result.camera += sum;
}

void MapSystem::add_field(const MapUnknowns& at, MapUnknowns& result) const {
    MapField field = solution_.field;
    field.values() = at.field;
    for (std::size_t i = 0; i < grid_.dots(); ++i) {
        const auto [column, row] = grid_.cell_of(i);
        const MapField::Around near = field.around(column, row);
        Vector2d off = -offsets_[i];
        for (std::size_t k = 0; k < near.nodes.size(); ++k)
            off += near.weights[k] * at.field[near.nodes[k]];
        for (std::size_t k = 0; k < near.nodes.size(); ++k)
            result.field[near.nodes[k]] += prior_weight_ * near.weights[k] * off;
    }
    field.add_prior(at.field, result.field);
}

MapUnknowns MapSystem::product(const MapUnknowns& at, Residuals residuals) {
    eliminate(at, residuals);
    MapUnknowns result = zeros();
    add_frames(at, residuals, result);
    add_field(at, result);
    return result;
}

void MapSystem::make_preconditioner() {
    using CameraBlock = Eigen::Matrix<double, kCameraTerms, kCameraTerms>;
    const auto& frames = solution_.frames;
    frame_blocks_.resize(frames.size());
    std::array<CameraBlock, kMapParts> camera;
    camera.fill(CameraBlock::Zero());
    for_each_item(frames.size(), [&](int part, std::size_t f) {
        CameraBlock& camera_sum = camera[static_cast<std::size_t>(part)];
        const MapView view(grid_, frames[f], solution_.reach_mm);
        FrameBlock block = FrameBlock::Zero();
        for (std::size_t k = 0; k < frames[f].count; ++k) {
            const MapObservation& seen = observations_[frames[f].first + k];
            if (seen.is_outlier()) continue;
            const MapView::Terms terms = view.terms(seen);
            const auto derivatives = terms.derivatives();
            const double weight = weight_ * (1 - weight_ / information_[seen.dot]);
            block += weight * derivatives.transpose() * derivatives;
            Eigen::Matrix<double, 2, kCameraTerms> shared;
            shared.leftCols<kViewTerms>() = derivatives.rightCols<kViewTerms>();
            const double square = terms.x * terms.x + terms.y * terms.y;
            shared.col(kViewTerms) << square * terms.x, square * terms.y;
            camera_sum += weight * shared.transpose() * shared;
        }
        add_view_prior(solution_, 1, block);
        frame_blocks_[f].compute(block);
    });
    CameraBlock sum = CameraBlock::Zero();
    for (const CameraBlock& part : camera)
        sum += part;
    sum.diagonal().array() += 1e-9 * sum.diagonal().maxCoeff();
    camera_block_.compute(sum);
    MapField field = solution_.field;
    field_diagonal_.assign(field.nodes(), 0);
    for (std::size_t i = 0; i < grid_.dots(); ++i) {
        const auto [column, row] = grid_.cell_of(i);
        const MapField::Around near = field.around(column, row);
        const double weight = prior_weight_ * (1 - prior_weight_ / information_[i]);
        for (std::size_t k = 0; k < near.nodes.size(); ++k)
            field_diagonal_[near.nodes[k]] += weight * near.weights[k] * near.weights[k];
    }
    field.add_prior_diagonal(field_diagonal_);
}

MapUnknowns MapSystem::preconditioned(const MapUnknowns& residual) const {
    MapUnknowns result = residual;
    for (std::size_t f = 0; f < result.frames.size(); ++f)
        result.frames[f] = frame_blocks_[f].solve(residual.frames[f]);
    result.camera = camera_block_.solve(residual.camera);
    for (std::size_t i = 0; i < result.field.size(); ++i)
        result.field[i] /= field_diagonal_[i];
    deformation_.add_solution(residual, result);
    keep_scale(result);
    return result;
}

void MapSystem::keep_scale(MapUnknowns& unknowns) {
    constexpr int kScale = kFrameTerms - kViewTerms;
    double mean = 0;
    for (const FrameVector& frame : unknowns.frames)
        mean += frame[kScale] / static_cast<double>(unknowns.frames.size());
    for (FrameVector& frame : unknowns.frames)
        frame[kScale] -= mean;
    unknowns.camera[0] = 0;
}

void MapSystem::solve(MapSolution& solution, double converged, const MapProgress& progress) {
    MapUnknowns at = unknowns_of(solution);
    MapUnknowns residual = product(at, Residuals::add);
    residual.combine(-1, 0, residual);
    keep_scale(residual);
    MapUnknowns direction = preconditioned(residual);
    double size = residual.inner(direction);
    const auto unknowns = static_cast<double>(kFrameTerms * at.frames.size() + 2 * at.field.size());
    int i = 0;
    for (; i < kMaxIterations && size > converged * unknowns; ++i) {
        progress(static_cast<double>(i) / kMaxIterations);
        MapUnknowns image = product(direction, Residuals::omit);
        keep_scale(image);
        const double step = size / direction.inner(image);
        at.combine(1, step, direction);
        residual.combine(1, -step, image);
        const MapUnknowns next = preconditioned(residual);
        const double next_size = residual.inner(next);
        direction.combine(next_size / size, 1, next);
        size = next_size;
    }
    solution.iterations += i;
    eliminate(at, Residuals::add);
    write(at, solution);
}

void MapSystem::write(const MapUnknowns& at, MapSolution& solution) {
    for (std::size_t f = 0; f < solution.frames.size(); ++f) {
        MapFrame& frame = solution.frames[f];
        const MapView view(grid_, frame, solution.reach_mm);
        frame.place_mm += view.page_from_camera() * at.frames[f].head<2>();
        frame.angle_rad += at.frames[f][2] / solution.reach_mm;
        frame.displacement_mm += at.frames[f][3];
        frame.view = at.frames[f].tail<kViewTerms>();
    }
    solution.camera = at.camera;
    solution.field.values() = at.field;
    for (std::size_t i = 0; i < offsets_.size(); ++i)
        solution.offset_mm[i] = offsets_[i].cast<float>();
}

}  // namespace dotpose::calibrate
