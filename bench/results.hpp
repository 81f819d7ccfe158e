/// Collects the times of all benchmarks in a run.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace dotpose::bench {

struct Result {
    double us = 0;    ///< time of one call in the fastest repetition, in µs
    double dots = 0;  ///< mean number of dots in the frames, or 0 for benchmarks without frames
};

/// Prints and stores only the fastest repetition of each benchmark, because other load on the
/// machine can only slow a repetition down.
class Results : public benchmark::ConsoleReporter {
  public:
    Results();

    /// Returns the result of a benchmark. Throws Error if the benchmark failed or was not run.
    const Result& of(const std::string& name) const;
    bool has_failed() const { return has_failed_; }

    void ReportRuns(const std::vector<Run>& repetitions) override;

  private:
    std::map<std::string, Result> results_;
    bool has_failed_ = false;
};

}  // namespace dotpose::bench
