/// `dotpose evaluate --sheets`: compares located frames with places that were measured on sheets or
/// in the world.
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

/// Options for an evaluation with a sheet file.
struct MeasuredArguments {
    std::string sheets;      ///< sheet file, or empty for poses in the pattern frame
    bool is_aligned = true;  ///< true to align the located places with the true places
    bool alignment_given = false;
    std::string residuals;  ///< CSV file for the error of each frame, or empty for none
    std::string draw;       ///< folder for the figures, or empty for none

    void add_to(Command& command);
    void add_files(RunFiles& files) const;

    /// Throws BadArgument if another option of this group is given without --sheets.
    void require_sheets() const;
};

/// Returns {"median": ..., "p95": ..., "max": ...}, with null for NaN.
nlohmann::ordered_json quantiles_json(const Quantiles& quantiles);

/// Locates the frames in order, compares the located poses with the true poses and writes the
/// report. Returns the exit status.
int evaluate_measured(const MeasuredArguments& arguments, const FollowerOptions& options,
                      const KnownFrames& known, const ReportArguments& report);

}  // namespace dotpose::cli
