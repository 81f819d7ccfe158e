/// `dotpose evaluate --sheets`: frames with places that were measured on sheets or in the world.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "common.hpp"
#include "dotpose/tools/measured.hpp"
#include "follower_arguments.hpp"
#include "known_frames.hpp"
#include "output_arguments.hpp"
#include "run_files.hpp"

namespace dotpose::cli {

/// The options of evaluations with a sheet file.
struct MeasuredArguments {
    std::string sheets;      ///< sheet file; empty: poses are in the pattern frame
    bool is_aligned = true;  ///< whether found places are aligned to the true ones
    bool alignment_given = false;
    std::string residuals;  ///< CSV file with the error of each frame; empty for none
    std::string draw;       ///< folder for the figures; empty for none

    void add_to(Command& command);
    void add_files(RunFiles& files) const;

    /// Throws BadArgument for options that need --sheets if it is missing.
    void require_sheets() const;
};

/// Returns {"median": ..., "p95": ..., "max": ...}; what is NaN becomes null.
nlohmann::ordered_json quantiles_json(const Quantiles& quantiles);

/// Locates the frames one after the other, compares them and writes the report. Returns the exit
/// status.
int evaluate_measured(const MeasuredArguments& arguments, const FollowerOptions& options,
                      const KnownFrames& known, const ReportArguments& report);

}  // namespace dotpose::cli
