// Renders frames that contain no valid position. The camera, lighting and printing errors are taken
// from the shot.
#include <algorithm>
#include <cmath>

#include "simulate/ink.hpp"

namespace dotpose {
namespace {

using simulate::Ink;
using simulate::View;

// Returns a pseudo-random symbol that depends only on the seed and the cell.
Symbol random_symbol(std::uint64_t seed, Cell cell) {
    return static_cast<Symbol>(Rng(seed, (std::uint64_t{cell.x} << 32) | cell.y).bits() >> 62);
}

simulate::DisplacementOf displacement_in(Scene scene, const Shot& shot) {
    const Pattern pattern = shot.page.pattern;
    // The section beyond the seam differs in both u and v, so neither x nor y can be read across
    // the seam.
    Pattern beyond = pattern;
    beyond.section = {static_cast<std::uint8_t>((pattern.section.u + 29) % kSections),
                      static_cast<std::uint8_t>((pattern.section.v + 31) % kSections)};
    const Cell seam = shot.pose.cell;
    const std::uint64_t seed = shot.seed;
    return [=](Cell cell) {
        if (scene == Scene::plain_grid) return Vec2{};
        const bool is_beyond = (scene == Scene::seam_vertical && cell.x > seam.x) ||
                               (scene == Scene::seam_horizontal && cell.y > seam.y);
        const Pattern& here = is_beyond ? beyond : pattern;
        const Symbol symbol = scene == Scene::random_symbols
                                  ? random_symbol(seed, cell)
                                  : symbol_at(here.code, cell, here.section);
        return Vec2{static_cast<double>(dx(symbol)), static_cast<double>(dy(symbol))};
    };
}

void add_text(Ink& ink, const View& view, double reflectance, Rng& rng) {
    const simulate::OffsetBox box = visible_offsets(view);
    const double height_mm = rng.uniform(1.2, 2.5);
    const double line_mm = 1.7 * height_mm;
    const double left_mm = box.low_mm.x - height_mm * rng.uniform();
    for (double y_mm = box.low_mm.y + line_mm * rng.uniform(); y_mm < box.high_mm.y + line_mm;
         y_mm += line_mm) {
        double x_mm = left_mm;
        while (x_mm < box.high_mm.x) {
            const int letters = 1 + static_cast<int>(rng.below(9));
            add_word(ink, view, {{x_mm, y_mm}, 0, height_mm, letters, 0.12 * height_mm},
                     reflectance, rng);
            x_mm += (letters * simulate::kLetterAdvance + 0.4) * height_mm;
        }
    }
}

void add_checkerboard(Ink& ink, const View& view, double side_mm, double reflectance) {
    const simulate::OffsetBox box = visible_offsets(view);
    const auto index = [&](double mm) { return static_cast<int>(std::floor(mm / side_mm)); };
    for (int j = index(box.low_mm.y); j <= index(box.high_mm.y); ++j) {
        for (int i = index(box.low_mm.x); i <= index(box.high_mm.x); ++i) {
            if ((i + j) % 2 != 0) continue;
            simulate::InkPolygon square{{}, reflectance};
            for (const auto& [x, y] : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) {
                square.corners_px.push_back(
                    view.projection.pixel_from_offset({(i + x) * side_mm, (j + y) * side_mm}));
            }
            ink.polygons.push_back(std::move(square));
        }
    }
}

void add_scattered(Ink& ink, const View& view, const Shot& shot, double density, Rng& rng) {
    const simulate::OffsetBox box = visible_offsets(view);
    const Pattern& pattern = shot.page.pattern;
    const double area_mm2 = (box.high_mm.x - box.low_mm.x) * (box.high_mm.y - box.low_mm.y);
    const double count = density * area_mm2 / (pattern.spacing_mm * pattern.spacing_mm);
    for (int i = 0; i < count; ++i) {
        const double x_mm = rng.uniform(box.low_mm.x, box.high_mm.x);
        const double y_mm = rng.uniform(box.low_mm.y, box.high_mm.y);
        add_disc(ink, view, {x_mm, y_mm}, pattern.dot_mm / 2, shot.imperfections.ink_reflectance);
    }
}

void add_scene(Ink& ink, const View& view, Scene scene, const Shot& shot, double density,
               Rng& rng) {
    const double reflectance = shot.imperfections.ink_reflectance;
    switch (scene) {
        case Scene::white:
        case Scene::black:
        case Scene::noise:
            return;
        case Scene::text:
            return add_text(ink, view, reflectance, rng);
        case Scene::checkerboard:
            return add_checkerboard(ink, view, 2 * shot.page.pattern.spacing_mm, reflectance);
        case Scene::scattered_dots:
            return add_scattered(ink, view, shot, density, rng);
        case Scene::plain_grid:
        case Scene::random_symbols:
        case Scene::seam_vertical:
        case Scene::seam_horizontal:
        case Scene::mirrored:
            return add_dots(ink, view, shot.page, shot.imperfections, displacement_in(scene, shot));
    }
    throw BadArgument("unknown scene");
}

void mirror(GreyImage& image) {
    const auto width = static_cast<std::ptrdiff_t>(image.width_px);
    for (auto row = image.pixels.begin(); row != image.pixels.end(); row += width) {
        std::reverse(row, row + width);
    }
}

GreyImage white_noise(const Shot& shot, double density) {
    GreyImage image;
    image.width_px = shot.camera.width_px;
    image.height_px = shot.camera.height_px;
    const Imperfections& seen = shot.imperfections;
    const auto light = static_cast<std::uint8_t>(std::lround(seen.paper_level));
    const auto dark =
        static_cast<std::uint8_t>(std::lround(seen.paper_level * seen.ink_reflectance));
    Rng rng(shot.seed);
    const auto pixels =
        static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
    for (std::size_t i = 0; i < pixels; ++i) {
        image.pixels.push_back(rng.uniform() < density ? dark : light);
    }
    return image;
}

}  // namespace

const char* name(Scene scene) {
    switch (scene) {
        case Scene::black:
            return "black";
        case Scene::white:
            return "white";
        case Scene::noise:
            return "noise";
        case Scene::text:
            return "text";
        case Scene::plain_grid:
            return "plain_grid";
        case Scene::random_symbols:
            return "random_symbols";
        case Scene::scattered_dots:
            return "scattered_dots";
        case Scene::checkerboard:
            return "checkerboard";
        case Scene::seam_vertical:
            return "seam_vertical";
        case Scene::seam_horizontal:
            return "seam_horizontal";
        case Scene::mirrored:
            return "mirrored";
    }
    return "?";
}

GreyImage render_scene(Scene scene, const Shot& shot, double density) {
    if (!(density >= 0 && density <= 1)) throw BadArgument("the density must be 0 to 1");
    simulate::check(shot.page, shot.camera, shot.pose, shot.imperfections);
    if (scene == Scene::noise) return white_noise(shot, density);

    Imperfections seen = shot.imperfections;
    if (scene == Scene::black) seen.paper_level = 0;
    const View view(shot.camera, shot.pose, seen);
    Rng rng(shot.seed);
    Ink ink;
    add_scene(ink, view, scene, shot, density, rng);
    add_graphics(ink, view, seen, rng);
    add_dirt(ink, view, shot.page.pattern.dot_mm, seen, rng);
    GreyImage image =
        simulate::read_out(expose(ink, view, shot.page, seen), shot.camera, seen, rng);
    if (scene == Scene::mirrored) mirror(image);
    return image;
}

}  // namespace dotpose
