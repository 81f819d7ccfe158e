# Functions that run once per frame are optimized for size, which leaves flash for the others.
compile_core(-Os code/basis.cpp code/decode.cpp code/encode.cpp device/locate.cpp core/row_locator.cpp core/math/plane.cpp
             device/attempt.cpp device/tracked.cpp core/steps.cpp
             core/integrity/likelihood_ratios.cpp core/decode/orientation.cpp core/decode/lines.cpp
             core/decode/position.cpp core/integrity/seam_alternatives.cpp
             core/integrity/unshared_lines.cpp core/integrity/verify.cpp core/decode/window.cpp
             core/detect/undistort.cpp core/lattice/axes.cpp core/lattice/neighbours.cpp
             device/origin.cpp device/predicted.cpp device/turn.cpp
             core/pose/subgrid.cpp device/tracked_pose.cpp)
# These are short; they save 32 bytes each.
compile_core(-Os device/near_dot.cpp device/coded_cells.cpp)
# This saves 128 bytes, for 1,200 instructions in a tracked frame.
compile_core(-Os code/rolls.cpp)
# A pointer for each array, in place of one index for all, would take 48 bytes more.
compile_core("-Os;-fno-ivopts" core/decode/search.cpp)
compile_core(-O3 core/decode/correlation.cpp core/detect/blobs.cpp core/detect/runs.cpp)
# This keeps constants in registers.
compile_core(-fno-tree-pre device/read_dots.cpp core/detect/tiles.cpp)
# The expressions it would compute early take 32 bytes more.
compile_core(-fno-tree-pre device/grow.cpp)
