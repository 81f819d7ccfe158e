#include "evaluate/raster.hpp"

#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

#include <cairo.h>
#include <fmt/core.h>
#include <librsvg/rsvg.h>

#include "dotpose/files/error.hpp"
#include "draw/svg.hpp"

namespace dotpose::draw {
namespace {

constexpr double kPixelsPerUnit = 2;

template <auto Free>
struct Freed {
    template <typename Object>
    void operator()(Object* object) const {
        Free(object);
    }
};
using Drawing = std::unique_ptr<RsvgHandle, Freed<g_object_unref>>;
using Surface = std::unique_ptr<cairo_surface_t, Freed<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Freed<cairo_destroy>>;
using Problem = std::unique_ptr<GError, Freed<g_error_free>>;

[[noreturn]] void fail(const std::filesystem::path& path, GError* error) {
    const Problem problem(error);
    throw Error(fmt::format("cannot draw {}: {}", path.string(), problem->message));
}

Surface rendered(const std::filesystem::path& path, const std::string& svg) {
    GError* error = nullptr;
    const auto* text = reinterpret_cast<const guint8*>(svg.data());
    const Drawing drawing(rsvg_handle_new_from_data(text, svg.size(), &error));
    if (!drawing) fail(path, error);
    RsvgRectangle page{};
    rsvg_handle_get_intrinsic_size_in_pixels(drawing.get(), &page.width, &page.height);
    page.width = std::ceil(page.width * kPixelsPerUnit);
    page.height = std::ceil(page.height * kPixelsPerUnit);
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(page.width),
                                               static_cast<int>(page.height)));
    const Context context(cairo_create(surface.get()));
    if (rsvg_handle_render_document(drawing.get(), context.get(), &page, &error) == 0) {
        fail(path, error);
    }
    return surface;
}

}  // namespace

void write_png(const std::filesystem::path& path, const std::string& svg) {
    const Surface surface = rendered(path, svg);
    const cairo_status_t status = cairo_surface_write_to_png(surface.get(), path.c_str());
    if (status != CAIRO_STATUS_SUCCESS) {
        throw Error(
            fmt::format("cannot write {}: {}", path.string(), cairo_status_to_string(status)));
    }
}

void write_figure(const std::filesystem::path& folder, const std::string& name,
                  const std::function<void(std::ostream&)>& draw) {
    std::ostringstream drawn;
    draw(drawn);
    const std::string svg = std::move(drawn).str();
    write_file(folder / (name + ".svg"), [&](std::ostream& out) { out << svg; });
    write_png(folder / (name + ".png"), svg);
}

}  // namespace dotpose::draw
