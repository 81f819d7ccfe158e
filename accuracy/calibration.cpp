// Measures the errors of calibrations, also relative to the standard deviations that they report,
// in many simulated calibrations of each kind. Prints every number of docs/calibration.md.
#include <cstdlib>
#include <string>

#include "calibration_measures.hpp"

namespace dotpose {
namespace {

struct Arguments {
    std::uint64_t calibrations = 200;
    std::uint64_t large = 10;
    std::uint64_t spins = 50;
    std::uint64_t tables = 20;
    std::string example;  ///< folder for the example; empty for none
    Counting counting;
};

int run(const Arguments& arguments) {
    if (!arguments.example.empty()) {
        write_example(arguments.example, arguments.counting.seed);
        return EXIT_SUCCESS;
    }
    measure_lenses(arguments.calibrations, arguments.large, arguments.counting);
    measure_spins(arguments.spins, arguments.counting);
    measure_stitching(arguments.tables, arguments.counting);
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace dotpose

int main(int argc, char** argv) {
    using namespace dotpose;
    Arguments arguments;
    cli::Command app("How far are calibrations off, and do they know it?", "dotpose_calibration");
    add_count(app, "--calibrations", arguments.calibrations, "How many of small cameras");
    add_count(app, "--large", arguments.large, "How many of large ones");
    add_count(app, "--spins", arguments.spins, "How many of robots that turn on the spot");
    add_count(app, "--tables", arguments.tables, "How many of four sheets");
    app.add_option("--example", arguments.example,
                   "Write the frames of docs/calibration.md to this folder, and nothing else")
        ->type_name("DIR");
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
