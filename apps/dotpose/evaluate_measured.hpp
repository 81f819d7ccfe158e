/// `dotpose evaluate --sheets`: compares fixes with places measured on sheets or in the world.
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

/// Options for the evaluation with a sheet file.
struct MeasuredArguments {
    std::string sheets;      ///< path of the sheet file, or empty for poses in the pattern frame
    bool is_aligned = true;  ///< true to align the located places with the true places
    bool alignment_given = false;
    std::string residuals;  ///< path of the CSV file with the error of each frame, or empty
    std::string draw;       ///< folder for the figures, or empty for no figures

    void add_to(Command& command);
    void add_files(RunFiles& files) const;

    /// Throws BadArgument if any other option of this struct is given without --sheets.
    void require_sheets() const;
};

/// Returns {"median": ..., "p95": ..., "max": ...}. NaN becomes null.
nlohmann::ordered_json quantiles_json(const Quantiles& quantiles);

/// Locates the frames in order, compares the fixes with the true poses, and writes the report.
/// Returns the exit status.
int evaluate_measured(const MeasuredArguments& arguments, const FollowerOptions& options,
                      const KnownFrames& known, const ReportArguments& report);

}  // namespace dotpose::cli
