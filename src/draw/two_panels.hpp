// Layout of two square panels side by side, each with a title and a legend above it.
#pragma once

#include <string>

#include "draw/svg.hpp"

namespace dotpose::draw {

inline constexpr double kPanelMargin = 30;
inline constexpr double kPanelHead = 74;
inline constexpr double kPanelSide = 520;

inline Svg two_panels(const std::string& title) {
    return Svg(2 * kPanelSide + 3 * kPanelMargin, kPanelSide + kPanelHead + 2 * kPanelMargin,
               title);
}

/// Returns the top left corner of a panel's square. `panel` is 0 or 1.
inline Point panel_corner(int panel) {
    return {kPanelMargin + panel * (kPanelSide + kPanelMargin), kPanelMargin + kPanelHead};
}

inline void draw_panel_head(int panel, const std::string& title, const std::string& legend,
                            Svg& svg) {
    const Point at = panel_corner(panel);
    svg.text({at.x, at.y - 44}, 24, title, R"(font-weight="bold" fill="#17202a")");
    svg.text({at.x, at.y - 14}, 17, legend, R"(fill="#6b7885")");
}

}  // namespace dotpose::draw
