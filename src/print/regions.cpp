#include "regions.hpp"

#include <algorithm>

namespace dotpose::print {

Cell Regions::take(int columns, int rows) {
    const auto width = static_cast<std::uint32_t>(columns);
    const auto height = static_cast<std::uint32_t>(rows);
    const bool line_is_full = next_.x >= kPositionsPerAxis || width > kPositionsPerAxis - next_.x;
    if (line_is_full && line_rows_ > 0) {
        next_ = {start_.x, next_.y + line_rows_};
        line_rows_ = 0;
    }
    const Cell cell = next_;
    next_.x += width;
    line_rows_ = std::max(line_rows_, height);
    return cell;
}

}  // namespace dotpose::print
