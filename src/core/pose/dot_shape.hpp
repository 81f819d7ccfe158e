// Dot shape: size and blur of the dots of a frame, by a model dot fitted to their mean images.
#pragma once

#include "core/pose/stacked_dots.hpp"

namespace dotpose::core {

/// The model dot of a frame, and how well it is known.
class DotShape {
  public:
    /// Terms of the fit: how far all dots are off along u and v; squared half axes and blur of the
    /// model dot; its darkness, and that of the paper.
    enum Term : std::size_t {
        off_u,
        off_v,
        radius_u,
        radius_v,
        blur_u,
        blur_v,
        mass,
        paper,
        count
    };
    using Terms = std::array<float, Term::count>;

    /// Fits the model to the stacks. Returns false if their dots are not enough, or do not
    /// determine it.
    bool fit(const StackedDots& stacks);

    /// Draws the whole model dot at a place.
    DotImages drawn_at(FloatVec centre) const {
        return draw(dot(terms_, centre), DotPixels::kHalf_px);
    }
    /// Returns the variance of the blur along each axis, px^2.
    FloatVec blur_2() const { return {terms_[blur_u], terms_[blur_v]}; }
    /// Returns how far dots are from where they were expected, px.
    FloatVec off() const { return {terms_[off_u], terms_[off_v]}; }
    /// Returns the variance of what depends on the terms with these derivatives. It includes how
    /// badly a model dot explains the images.
    float variance(const Terms& derivatives) const;
    /// Returns how much more is left of the images than noise explains: 1 for dots of this model.
    float misfit() const { return misfit_; }

  private:
    using Matrix = std::array<Terms, Term::count>;  ///< the lower triangle

    /// The terms' normal equations, and what they minimise.
    struct Normal {
        Matrix matrix{};
        Terms right{};
        float squares = 0;  ///< of what is left of the images, in variances
        float pixels = 0;
        float cost = 0;

        void add(const Terms& derivatives, float rest, float weight);
        void expect(Term term, float value, float sigma, const Terms& now);
    };

    static ModelDot dot(const Terms& terms, FloatVec centre) {
        return {centre, {terms[radius_u], terms[radius_v]}, {terms[blur_u], terms[blur_v]}};
    }
    static Normal equations(const StackedDots& stacks, const Terms& terms, const Terms& first,
                            float noise_2);
    static bool decompose(Matrix& matrix);
    static Terms whitened(const Matrix& factor, Terms terms);
    static Terms solution(const Matrix& factor, const Terms& right);
    static Terms changed(const Terms& terms, const Terms& step);

    Terms terms_{};
    Matrix factor_{};  ///< Cholesky's, of the terms' information
    float misfit_ = 1;
};

}  // namespace dotpose::core
