// Fuzzes the options that several commands share. Each line of the input is an argument. Invalid
// arguments must be refused with an error.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "common.hpp"
#include "dotpose/files/error.hpp"

namespace {

using namespace dotpose;

struct Values {
    CodeVariant code = CodeVariant::anoto;
    Section section;
    Cell cell;
    FixedLens lens;
    DeviceOptions options;
    CameraModel camera;
    cli::PatternArguments pattern;
    double number = 0;
    std::string paper = "A4";
};

void add_options(cli::Command& command, Values& values) {
    values.pattern.add_to(command);
    cli::add_cell_option(command, "--origin", values.cell, "");
    cli::add_lens_option(command, values.lens);
    cli::add_attempt_options(command, cli::ErrorRates::known_or_measured, values.options);
    cli::add_size_option(command, values.camera);
    command.add_option("--number", values.number);
    command.add_option("--paper", values.paper);
}

void require(bool holds) {
    if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream stream({reinterpret_cast<const char*>(data), size});
    std::vector<std::string> arguments;
    for (std::string line; std::getline(stream, line);)
        arguments.insert(arguments.begin(), line);
    Values values;
    cli::Command app;
    add_options(*app.add_subcommand("command"), values);
    cli::refuse_non_finite_numbers(app);
    arguments.emplace_back("command");
    try {
        app.parse(arguments);
        const Pattern pattern = values.pattern.pattern();
        require(std::isfinite(values.number) && std::isfinite(pattern.spacing_mm));
        require(pattern.section.u < kSections && pattern.section.v < kSections);
        require(values.camera.width_px > 0 && values.camera.height_px > 0);
        const Paper paper = paper_by_name(values.paper);
        require(paper.width_mm > 0 && paper.width_mm <= kMaxPage_mm);
        make_sheet({.pattern = pattern, .origin = values.cell, .paper = paper});
    } catch (const cli::UsageError&) {
        return 0;
    } catch (const Error& error) {
        require(!std::string(error.what()).empty());
    }
    return 0;
}
