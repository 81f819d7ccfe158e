/// Results: what the benchmarks of one run took.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace dotpose::bench {

struct Result {
    double us = 0;    ///< for one call, in the fastest of all repetitions
    double dots = 0;  ///< that the frames show, on average; 0 where there are none
};

/// Prints the fastest repetition of each benchmark, and keeps it: whatever else the machine does
/// makes the others slower.
class Results : public benchmark::ConsoleReporter {
  public:
    Results();

    /// Throws Error if that benchmark was not run, or failed.
    const Result& of(const std::string& name) const;
    bool has_failed() const { return has_failed_; }

    void ReportRuns(const std::vector<Run>& repetitions) override;

  private:
    std::map<std::string, Result> results_;
    bool has_failed_ = false;
};

}  // namespace dotpose::bench
