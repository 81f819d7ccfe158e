// Fuzzes `read_log` with arbitrary files. It must return rows from which statistics and a picture
// can be computed, or throw Error.
#include "reads_or_refuses.hpp"
#include "run_log.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dotpose;
    return fuzz::reads_or_refuses(data, size, [](const std::string& path) {
        const auto rows = cli::read_log(path);
        cli::statistics_of(rows);
        cli::draw_run(rows, "fuzzed");
    });
}
