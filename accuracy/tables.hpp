/// The tables of dotpose_tables. Each function adds its options to the run, calls `run.parse()`,
/// performs the measurements, and prints its table. It returns false if a fix is wrong or the run
/// was interrupted.
#pragma once

#include "table_run.hpp"

namespace dotpose::tables {

bool accuracy_table(TableRun& run);
bool adversarial_table(TableRun& run);
bool alike_table(TableRun& run);
bool bound_table(TableRun& run);
bool calibration_table(TableRun& run);
bool drive_table(TableRun& run);
bool golden_table(TableRun& run);
bool integrity_table(TableRun& run);
bool known_table(TableRun& run);
bool together_table(TableRun& run);
bool limits_table(TableRun& run);
bool misread_table(TableRun& run);
bool pens_table(TableRun& run);
bool print_map_table(TableRun& run);
bool print_map_drive_table(TableRun& run);
bool print_map_errors_table(TableRun& run);
bool print_map_scale_table(TableRun& run);
bool print_map_solver_table(TableRun& run);
bool readout_table(TableRun& run);
bool seams_table(TableRun& run);
bool slips_table(TableRun& run);
bool space_table(TableRun& run);
bool space_second_table(TableRun& run);
bool space_tag_table(TableRun& run);
bool space_track_table(TableRun& run);
bool tracked_table(TableRun& run);
bool views_table(TableRun& run);

}  // namespace dotpose::tables
