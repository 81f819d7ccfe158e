// The dotpose-tools.wasm module: sheets and the simulated camera, compiled from the sources of the
// command-line tool.
//
// A function that fails sets the message returned by `dotpose_tools_error` and ends the instance
// with a trap. The loader then throws the message in JavaScript and starts another instance.
// Because the stack is not unwound, the module needs no support for exceptions.
#include <cstdint>
#include <cstring>
#include <exception>
#include <string>
#include <typeinfo>
#include <vector>

#include "dotpose/tools/print.hpp"
#include "dotpose/tools/simulate.hpp"
#include "print/geometry.hpp"
#include "print/raster.hpp"
#include "print/symbol_rows.hpp"
#include "print/writers.hpp"
#include "requests.hpp"

namespace {

using namespace dotpose;

// An instance serves one call at a time. The result of a call is valid until the next call.
const char* error_text = "";
wasm::RenderRequest request;
wasm::SheetLayout layout;
std::vector<std::uint8_t> bytes;
std::vector<double> points_mm;

class MemorySink : public base::ByteSink {
  public:
    using ByteSink::write;
    void write(const void* data, std::size_t size_bytes) noexcept override {
        const auto* first = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), first, first + size_bytes);
    }
};

std::uint32_t natural(double value) {
    return static_cast<std::uint32_t>(value);
}

Pattern pattern_of(const wasm::SheetRequest& sheet) {
    return {
        static_cast<CodeVariant>(natural(sheet.code)),
        {static_cast<std::uint8_t>(sheet.section_u), static_cast<std::uint8_t>(sheet.section_v)},
        sheet.spacing_mm,
        sheet.displacement_mm,
        sheet.dot_mm};
}

Sheet sheet_of(const wasm::SheetRequest& sheet) {
    SheetOptions options;
    options.pattern = pattern_of(sheet);
    options.origin = {natural(sheet.origin_x), natural(sheet.origin_y)};
    options.paper = {sheet.paper_width_mm, sheet.paper_height_mm};
    options.margin_mm = sheet.margin_mm;
    return make_sheet(options);
}

/// Returns a page on a table. The paper has the size of the sheet.
Page page_on_table(const Sheet& sheet, double table_reflectance) {
    Page page = page_of(sheet);
    const double spacing_mm = sheet.pattern.spacing_mm;
    const auto middle = [&](std::uint32_t origin, double size_mm, double origin_mm) {
        return origin + (size_mm / 2 - origin_mm) / spacing_mm;
    };
    page.paper = PageArea{middle(sheet.origin.x, sheet.width_mm, sheet.origin_x_mm),
                          middle(sheet.origin.y, sheet.height_mm, sheet.origin_y_mm),
                          sheet.width_mm / 2 / spacing_mm, sheet.height_mm / 2 / spacing_mm, 0};
    page.table_reflectance = table_reflectance;
    return page;
}

Page requested_page() {
    Page page;
    if (request.whole_plane != 0) {
        page.pattern = pattern_of(request.sheet);
    } else {
        page = page_on_table(sheet_of(request.sheet), request.table_reflectance);
    }
    page.seed = static_cast<std::uint64_t>(request.page_seed);
    return page;
}

CameraModel camera_of(const wasm::CameraRequest& camera) {
    return {static_cast<int>(camera.width_px),
            static_cast<int>(camera.height_px),
            camera.mm_per_px,
            camera.k,
            camera.working_distance_mm,
            {}};
}

CameraPose pose_of(const wasm::CameraRequest& camera) {
    return {{natural(camera.cell_x), natural(camera.cell_y)},
            camera.fraction_x,
            camera.fraction_y,
            camera.theta_rad,
            camera.tilt_x_rad,
            camera.tilt_y_rad};
}

Imperfections imperfections_of(const wasm::ImperfectionsRequest& asked) {
    Imperfections result;
    result.paper_level = asked.paper_level;
    result.ink_reflectance = asked.ink_reflectance;
    result.ink_variation = asked.ink_variation;
    result.palest_ink = asked.palest_ink;
    result.vignetting = asked.vignetting;
    result.fall = asked.fall;
    result.fall_direction_rad = asked.fall_direction_rad;
    result.blur_sigma_px = asked.blur_sigma_px;
    result.motion_px = {asked.motion_x_px, asked.motion_y_px};
    result.noise_sigma = asked.noise_sigma;
    result.salt_and_pepper = asked.salt_and_pepper;
    result.jitter_mm = asked.jitter_mm;
    result.missing = asked.missing;
    result.dirt_blobs = static_cast<int>(asked.dirt_blobs);
    result.graphics = static_cast<int>(asked.graphics);
    result.texture = asked.texture;
    return result;
}

}  // namespace

extern "C" {

// Called by `throw`. All exceptions thrown in this module have std::exception as their first base
// class.
void* __cxa_allocate_exception(std::size_t size_bytes) noexcept {
    return ::operator new(size_bytes);
}
[[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) {
    error_text = static_cast<const std::exception*>(thrown)->what();
    __builtin_trap();
}

// Called by abort. There is no process that could exit, so the instance ends with a trap.
void __wasi_proc_exit(std::uint32_t) {
    __builtin_trap();
}

// Called when the memory has grown. Does nothing, because the loader recreates its views after each
// call. Without this definition, the module would import the function.
void emscripten_notify_memory_growth(std::size_t) {}

/// Returns the message of the error that ended the instance, or "" if there was no error.
const char* dotpose_tools_error() {
    return error_text;
}

/// Returns the address at which JavaScript writes the request for the next call.
double* dotpose_tools_request() {
    return &request.sheet.code;
}

/// Lays out the sheet and returns a SheetLayout.
const double* dotpose_tools_layout() {
    const Sheet sheet = sheet_of(request.sheet);
    layout = {static_cast<double>(sheet.columns), static_cast<double>(sheet.rows),
              sheet.origin_x_mm, sheet.origin_y_mm};
    return &layout.columns;
}

/// Returns the size of the previous call's result, in bytes.
std::size_t dotpose_tools_size() {
    return bytes.size();
}

/// Writes the sheet as SVG and returns the text.
const std::uint8_t* dotpose_tools_svg() {
    bytes.clear();
    MemorySink sink;
    print::write_svg(sheet_of(request.sheet), {}, sink);
    return bytes.data();
}

/// Draws the sheet and returns its rows, with 8 pixels per byte. A 1 bit is ink.
const std::uint8_t* dotpose_tools_raster(double dpi) {
    const Sheet sheet = sheet_of(request.sheet);
    validate_resolution(sheet, dpi);
    bytes.clear();
    print::rasterize(sheet, dpi, {}, [](std::span<const std::uint8_t> row) {
        bytes.insert(bytes.end(), row.begin(), row.end());
    });
    return bytes.data();
}

/// Returns the centres of all dots, as x and y in mm from the upper left corner of the page.
const double* dotpose_tools_dots() {
    const Sheet sheet = sheet_of(request.sheet);
    print::SymbolRows symbols(sheet);
    points_mm.clear();
    for (int j = 0; j < sheet.rows; ++j) {
        int i = 0;
        for (const Symbol symbol : symbols.row(j)) {
            points_mm.push_back(print::dot_x_mm(sheet, i++, dx(symbol)));
            points_mm.push_back(print::dot_y_mm(sheet, j, dy(symbol)));
        }
    }
    return points_mm.data();
}

/// Renders an image from the simulated camera and returns its grey levels.
const std::uint8_t* dotpose_tools_render() {
    bytes =
        render(requested_page(), camera_of(request.camera), pose_of(request.camera),
               imperfections_of(request.imperfections), static_cast<std::uint64_t>(request.seed))
            .pixels;
    return bytes.data();
}

}  // extern "C"
