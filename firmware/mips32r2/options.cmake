# Functions that run once per frame are optimized for size, which leaves flash for the others.
compile_core(-Os code/basis.cpp code/decode.cpp code/encode.cpp core/locate_device.cpp core/math/plane.cpp
             core/attempts/device.cpp core/attempts/device_tracked.cpp core/attempts/steps.cpp
             core/integrity/likelihood_ratios.cpp core/decode/orientation.cpp core/decode/lines.cpp
             core/decode/position.cpp core/integrity/seam_alternatives.cpp
             core/integrity/unshared_lines.cpp core/integrity/verify.cpp core/decode/window.cpp
             core/detect/undistort.cpp core/lattice/axes.cpp core/lattice/neighbours.cpp
             core/lattice/origin.cpp core/lattice/predicted.cpp core/lattice/turn.cpp
             core/pose/subgrid.cpp core/pose/tracked_pose.cpp)
# These are short; they save 32 bytes each.
compile_core(-Os core/detect/near_dot.cpp core/lattice/coded_cells.cpp)
# This saves 128 bytes, for 1,200 instructions in a tracked frame.
compile_core(-Os code/rolls.cpp)
# A pointer for each array, in place of one index for all, would take 48 bytes more.
compile_core("-Os;-fno-ivopts" core/decode/search.cpp)
compile_core(-O3 core/decode/correlation.cpp core/detect/blobs.cpp core/detect/runs.cpp)
# This keeps constants in registers.
compile_core(-fno-tree-pre core/decode/read_dots.cpp core/detect/tiles.cpp)
# The expressions it would compute early take 32 bytes more.
compile_core(-fno-tree-pre core/lattice/grow.cpp)
