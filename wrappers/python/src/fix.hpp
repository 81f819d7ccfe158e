/// The Python classes Fix and Prediction. They extend the C++ types with additional data.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "binding.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/prediction.hpp"
#include "stages.hpp"

namespace dotpose::python {

/// A place in another code that also explains a frame.
struct OtherPlace {
    CodeVariant code = CodeVariant::anoto;
    Cell cell;
    Section section;
};

/// A fix, the code in which it was read, and a reference to the stages of its frame.
struct PyFix {
    Fix fix;
    CodeVariant code = CodeVariant::anoto;
    std::optional<OtherPlace> other;
    /// Reference point of the pose, relative to the image centre, in units of 2^-8 px.
    FixedVec reference_q8;
    std::shared_ptr<StageSource> source;  ///< locator that located the frame
    std::uint64_t number = 0;             ///< number of the frame, counted by `source`
    /// Error message if an option is out of range, otherwise empty.
    std::string fault;
    std::shared_ptr<const Stages> stages;  ///< null until requested

    bool is_ok() const { return fix.status == Status::ok; }
    const Stages& seen_stages();
};

/// Returns a fix without a reference to its stages.
PyFix seen_fix(const CodeReading& reading);

/// A prediction, with the code, spacing and reference point for which it was made.
struct SeenPrediction {
    Prediction prediction;
    CodeVariant code = CodeVariant::anoto;
    double spacing_mm = 0;
    FixedVec pivot_q8;  ///< reference point, in 2^-8 px from the centre of the first pixel

    static SeenPrediction like(const PyFix& fix);
};

/// Converts a covariance in spacings and rad to mm and rad. Returns NaN if `is_known` is false.
py::array_t<double> covariance_array(const float (&covariance)[3][3], double spacing_mm,
                                     bool is_known);

}  // namespace dotpose::python
