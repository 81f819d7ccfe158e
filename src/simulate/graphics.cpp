#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "simulate/ink.hpp"

namespace dotpose::simulate {
namespace {

// Strokes of capital letters. Each stroke consists of four digits (x y x y): the coordinates of its
// two ends on a grid 2 units wide and 4 units high. y points up.
constexpr std::array<std::string_view, 14> kLetters = {
    "001414200121",      // A
    "000404240020",      // C
    "0004042402120020",  // E
    "000404240212",      // F
    "000420240222",      // H
    "1014",              // I
    "0004022402200000",  // K
    "00040020",          // L
    "0004041212242420",  // M
    "000404202024",      // N
    "0004042424200020",  // O
    "10140424",          // T
    "04101024",          // V
    "042424000020",      // Z
};

double at(std::string_view digits, std::size_t i) {
    return digits[i] - '0';
}

InkPolygon capsule(const View& view, Vec2 from_mm, Vec2 to_mm, double radius_mm,
                   double reflectance) {
    constexpr int kEndCorners = 6;
    const double along_rad = std::atan2(to_mm.y - from_mm.y, to_mm.x - from_mm.x);
    InkPolygon outline{{}, reflectance};
    for (int end = 0; end < 2; ++end) {
        const Vec2 centre = end == 0 ? to_mm : from_mm;
        for (int i = 0; i < kEndCorners; ++i) {
            const double turn = static_cast<double>(i) / (kEndCorners - 1) - 0.5 + end;
            const double angle_rad = along_rad + turn * std::numbers::pi;
            outline.corners_px.push_back(
                view.projection.pixel_from_offset({centre.x + radius_mm * std::cos(angle_rad),
                                                   centre.y + radius_mm * std::sin(angle_rad)}));
        }
    }
    return outline;
}

Vec2 random_offset(const View& view, Rng& rng) {
    return view.projection.offset_from_pixel(
        {rng.uniform(0, view.camera.width_px - 1), rng.uniform(0, view.camera.height_px - 1)});
}

}  // namespace

void add_stroke(Ink& ink, const View& view, const Stroke& stroke, double reflectance) {
    const Vec2 span{stroke.to_mm.x - stroke.from_mm.x, stroke.to_mm.y - stroke.from_mm.y};
    // Lens distortion bends lines, so a stroke is split into short pieces.
    const double piece_mm = 24 * view.camera.mm_per_px;
    const int pieces = std::max(1, static_cast<int>(std::hypot(span.x, span.y) / piece_mm));
    for (int piece = 0; piece < pieces; ++piece) {
        const auto point = [&](int i) {
            const double part = static_cast<double>(i) / pieces;
            return Vec2{stroke.from_mm.x + part * span.x, stroke.from_mm.y + part * span.y};
        };
        ink.polygons.push_back(
            capsule(view, point(piece), point(piece + 1), stroke.width_mm / 2, reflectance));
    }
}

void add_word(Ink& ink, const View& view, const Word& word, double reflectance, Rng& rng) {
    const double c = std::cos(word.angle_rad);
    const double s = std::sin(word.angle_rad);
    for (int i = 0; i < word.letters; ++i) {
        const std::string_view letter = kLetters[rng.below(kLetters.size())];
        const auto corner = [&](std::size_t digit) {
            const double x = (at(letter, digit) / 4 + i * kLetterAdvance) * word.height_mm;
            const double y = -at(letter, digit + 1) / 4 * word.height_mm;
            return Vec2{word.at_mm.x + c * x - s * y, word.at_mm.y + s * x + c * y};
        };
        for (std::size_t digit = 0; digit + 3 < letter.size(); digit += 4) {
            add_stroke(ink, view, {corner(digit), corner(digit + 2), word.stroke_mm}, reflectance);
        }
    }
}

void add_graphics(Ink& ink, const View& view, const Imperfections& imperfections, Rng& rng) {
    for (int i = 0; i < imperfections.graphics; ++i) {
        const Vec2 through = random_offset(view, rng);
        const double angle_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
        const Vec2 along{std::cos(angle_rad), std::sin(angle_rad)};
        const bool is_word = rng.uniform() < 0.5;
        const double size = rng.uniform();
        const double reflectance = imperfections.ink_reflectance;
        if (is_word) {
            const double height_mm = 1.5 + 1.5 * size;
            const int letters = 3 + static_cast<int>(rng.below(5));
            const double half_mm = letters * kLetterAdvance * height_mm / 2;
            add_word(ink, view,
                     {{through.x - half_mm * along.x, through.y - half_mm * along.y},
                      angle_rad,
                      height_mm,
                      letters,
                      0.14 * height_mm},
                     reflectance, rng);
        } else {
            const double half_mm = rng.uniform(1.5, 8);
            add_stroke(ink, view,
                       {{through.x - half_mm * along.x, through.y - half_mm * along.y},
                        {through.x + half_mm * along.x, through.y + half_mm * along.y},
                        0.3 + 0.9 * size},
                       reflectance);
        }
    }
}

void add_dirt(Ink& ink, const View& view, double dot_mm, const Imperfections& imperfections,
              Rng& rng) {
    const double dot_px = dot_mm / view.camera.mm_per_px;
    for (int i = 0; i < imperfections.dirt_blobs; ++i) {
        const Vec2 centre{rng.uniform(0, view.camera.width_px - 1),
                          rng.uniform(0, view.camera.height_px - 1)};
        const double a = dot_px * rng.uniform(0.3, 1.5);
        const double b = a * rng.uniform(0.5, 1);
        const double angle_rad = rng.uniform(0, std::numbers::pi);
        const double c = std::cos(angle_rad);
        const double s = std::sin(angle_rad);
        ink.ellipses.push_back({centre, a * a * c * c + b * b * s * s, (a * a - b * b) * c * s,
                                a * a * s * s + b * b * c * c, rng.uniform(0.15, 0.6)});
    }
}

}  // namespace dotpose::simulate
