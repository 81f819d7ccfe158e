// Dot shape: the size and blur of the dots in a frame, fitted to their stacked images.
#pragma once

#include "core/fit/normal_equations.hpp"
#include "core/pose/stacked_dots.hpp"

namespace dotpose::core {

/// A model dot fitted to the dots in a frame, with its uncertainty.
class DotShape {
  public:
    /// Terms of the fit. `offset_u` and `offset_v` are the mean offset of the dots from their
    /// expected centres. The radii are squared semi-axes. The blur terms are two variances and
    /// their covariance. `mass` is the total darkness of a dot. `paper` is the darkness of a pixel
    /// without ink, which is close to 0, because darkness is relative to the local paper level.
    enum Term : std::size_t {
        offset_u,
        offset_v,
        radius_u,
        radius_v,
        blur_u,
        blur_v,
        blur_uv,
        mass,
        paper,
        count
    };
    using Terms = std::array<float, Term::count>;

    /// Fits the model to the stacks. Returns false if there are too few dots, or if the stacks do
    /// not determine the model. The other functions may be called only after a successful fit.
    bool fit(const StackedDots& stacks);

    /// Draws the fitted dot (see `draw`). `centre` is in px relative to the central pixel.
    DotImages drawn_at(FloatVec centre, int half_px) const {
        return draw(dot(terms_, centre), half_px);
    }
    /// Returns the blur variance along each axis, in px^2.
    FloatVec blur_2() const { return {terms_[blur_u], terms_[blur_v]}; }
    /// Returns the mean offset of the dots from their expected centres, in px.
    FloatVec offset() const { return {terms_[offset_u], terms_[offset_v]}; }
    /// Returns the variance of a quantity that depends on the terms, given its derivatives with
    /// respect to the terms. This is the variance from the normal equations times `misfit()`,
    /// because residuals larger than the noise make the terms less certain.
    float variance(const Terms& derivatives) const;
    /// Returns the misfit: the reduced chi-squared of the fit, but at least 1. It is about 1 if the
    /// residuals contain only noise.
    float misfit() const { return misfit_; }

  private:
    /// Normal equations for a step, and the cost of the current terms.
    struct Normal : NormalEquations<Term::count> {
        /// Sum of squared image residuals, without the priors, in units of the noise variance.
        float squares = 0;
        float pixels = 0;
        float cost = 0;

        void add(const Terms& derivatives, float rest, float weight);
        bool decompose();
        void expect(Term term, float value, float sigma, const Terms& now);
    };

    static ModelDot dot(const Terms& terms, FloatVec centre) {
        return {centre,
                {terms[radius_u], terms[radius_v]},
                {terms[blur_u], terms[blur_v]},
                terms[blur_uv]};
    }
    static Normal equations(const StackedDots& stacks, const Terms& terms, const Terms& first,
                            float noise_2);
    static Terms changed(const Terms& terms, const Terms& step);

    Terms terms_{};
    Normal normal_;  ///< decomposed normal equations at the fitted terms
    float misfit_ = 1;
};

}  // namespace dotpose::core
