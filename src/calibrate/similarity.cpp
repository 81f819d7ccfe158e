#include "calibrate/similarity.hpp"

#include <cmath>

#include "calibrate/dot_fit.hpp"

namespace dotpose::calibrate {

Similarity fit_similarity(const std::vector<SimilarPoint>& points) {
    std::vector<DotEquation> equations;
    for (const SimilarPoint& point : points) {
        const auto& seen = point.seen;
        equations.push_back({AxisEquation{{1, 0, seen.x(), -seen.y(), -point.direction.x()},
                                          point.intersection.x()},
                             AxisEquation{{0, 1, seen.y(), seen.x(), -point.direction.y()},
                                          point.intersection.y()}});
    }
    const auto parameters = fit_dots(equations, 5).parameters;
    return {{parameters[0], parameters[1]},
            std::atan2(parameters[3], parameters[2]),
            std::hypot(parameters[2], parameters[3]),
            parameters[4]};
}

}  // namespace dotpose::calibrate
