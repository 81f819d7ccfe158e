// Observations: the dots that were read, with their intersections and symbols in the code.
#pragma once

#include "core/decode/nominal.hpp"
#include "core/detect/paper.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core {

struct Observation {
    FixedVec image_point_q8;
    FixedVec pattern_step;  ///< intersection, in spacings relative to `Decoding::place`
    Symbol symbol;
};

/// Returns the printed position of a dot, in 2^-16 spacings relative to `Decoding::place`.
inline FixedVec nominal_place_q16(const Observation& o, std::int32_t displacement_q16) {
    return {o.pattern_step.x * 65536 + dx(o.symbol) * displacement_q16,
            o.pattern_step.y * 65536 + dy(o.symbol) * displacement_q16};
}

/// The dots in a grid, with their symbols in the code.
class Observations {
  public:
    /// `paper` contains the paper levels for `noise`. If `paper` is null, `noise` must not be
    /// called.
    Observations(std::span<const DetectedDot> dots, const Grid& grid, const Nominal& nominal,
                 const PaperMap* paper = nullptr)
        : dots_(dots), grid_(grid), nominal_(nominal), paper_(paper) {}

    bool know_noise() const { return paper_ != nullptr; }
    /// Returns the variance of a dot's centre due to pixel noise, relative to that of a dot on
    /// white paper (level 255). Assumes that the pixel noise is constant, and that the contrast of
    /// a dot is proportional to the paper level.
    float noise(const Observation& o) const {
        const float light =
            static_cast<float>(paper_at(*paper_, o.image_point_q8.x >> 8, o.image_point_q8.y >> 8));
        return 255.0F * 255.0F / (light * light);
    }

    /// Returns an upper bound on the number of observations.
    int count() const { return static_cast<int>(dots_.size()); }

    /// Calls `use` for every n-th observation, where n is `every`.
    template <typename Use>
    void visit(Use use, int every = 1) const {
        const FixedVec along_row = nominal_.pattern_step({1, 0});
        const GridCell* cell = grid_.storage.data();
        int skipped = 0;
        for (int j = grid_.j0; j < grid_.j0 + grid_.rows; ++j) {
            FixedVec step = nominal_.pattern_step({grid_.i0, j});
            for (const GridCell* end = cell + grid_.columns; cell != end;
                 ++cell, step = step + along_row) {
                if (!cell->has_dot() || ++skipped < every) continue;
                skipped = 0;
                use(Observation{dots_[cell->dot].centre_q8, step, nominal_.symbol(step)});
            }
        }
    }

  private:
    std::span<const DetectedDot> dots_;
    const Grid& grid_;
    const Nominal& nominal_;
    const PaperMap* paper_;
};

}  // namespace dotpose::core
