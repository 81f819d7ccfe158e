// Simulates many calibrations of each kind. Measures their errors, both absolute and relative to
// the reported standard deviations. Prints all numbers in docs/calibration.md.
//
//   dotpose_tables calibration [--calibrations N] [--large N] [--spins N] [--tables N] [--seed S]
//                              [--threads N]
//   dotpose_tables calibration --example DIR [--seed S]
#include "calibration.hpp"

#include <string>

#include "tables.hpp"

namespace dotpose::tables {

bool calibration_table(TableRun& run) {
    std::uint64_t calibrations = 200;
    std::uint64_t large = 10;
    std::uint64_t spins = 50;
    std::uint64_t tables = 20;
    std::string example;
    run.add_count("--calibrations", calibrations, "Number of calibrations of small cameras");
    run.add_count("--large", large, "Number of calibrations of large cameras");
    run.add_count("--spins", spins, "Number of robots that turn on the spot");
    run.add_count("--tables", tables, "Number of tables of four sheets");
    run.command
        .add_option("--example", example,
                    "Only write the frames of docs/calibration.md to this folder")
        ->type_name("DIR");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;
    if (!example.empty()) {
        write_example(example, run.seed);
        return true;
    }
    measure_lenses(calibrations, large, run);
    measure_spins(spins, run);
    measure_stitching(tables, run);
    return true;
}

}  // namespace dotpose::tables
