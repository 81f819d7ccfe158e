#include "results.hpp"

#include <algorithm>

#include <unistd.h>

#include <dotpose/files/error.hpp>

namespace dotpose::bench {
namespace {

/// Returns the CPU time per call, in µs. CPU time depends less on other processes than wall-clock
/// time.
double us_of(const benchmark::BenchmarkReporter::Run& run) {
    return 1e6 * run.cpu_accumulated_time / static_cast<double>(run.iterations);
}

}  // namespace

Results::Results() : ConsoleReporter(isatty(STDOUT_FILENO) == 1 ? OO_Color : OO_None) {}

const Result& Results::of(const std::string& name) const {
    const auto found = results_.find(name);
    if (found == results_.end()) throw Error("no result of the benchmark " + name);
    return found->second;
}

void Results::ReportRuns(const std::vector<Run>& repetitions) {
    if (repetitions.front().run_type != Run::RT_Iteration) return;  // ignore aggregate statistics
    Run fastest = *std::ranges::min_element(repetitions, {}, us_of);
    fastest.run_name.repetitions.clear();
    ConsoleReporter::ReportRuns({fastest});
    // A benchmark that finds a wrong result stops before its first iteration.
    if (std::ranges::any_of(repetitions, [](const Run& run) { return run.iterations == 0; })) {
        has_failed_ = true;
        return;
    }
    Result& result = results_[fastest.run_name.function_name];
    result.us = us_of(fastest);
    const auto dots = fastest.counters.find("dots");
    if (dots != fastest.counters.end()) result.dots = dots->second;
}

}  // namespace dotpose::bench
