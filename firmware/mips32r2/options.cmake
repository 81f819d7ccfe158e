# Functions that run once per frame are optimized for size, to leave flash memory for other
# functions.
compile_core(-Os code/basis.cpp code/decode.cpp code/encode.cpp device/locate.cpp core/row_locator.cpp
             core/math/plane.cpp device/attempt.cpp device/in_whole_code.cpp device/tracked.cpp core/steps.cpp
             core/integrity/likelihood_ratios.cpp core/decode/orientation.cpp core/decode/lines.cpp
             core/decode/position.cpp core/integrity/seam_alternatives.cpp core/integrity/verify.cpp
             core/decode/window.cpp core/detect/undistort.cpp core/lattice/axes.cpp
             core/lattice/neighbours.cpp device/origin.cpp device/predicted.cpp device/turn.cpp
             core/pose/subgrid.cpp device/tracked_pose.cpp)
# -Os saves 32 bytes in each of these short functions.
compile_core(-Os device/near_dot.cpp device/coded_cells.cpp)
# With -fivopts, GCC would use one pointer per array instead of one index for all arrays. This takes
# 48 bytes more.
compile_core("-Os;-fno-ivopts" core/decode/search.cpp)
compile_core(-O3 core/decode/correlation.cpp core/detect/blobs.cpp core/detect/runs.cpp)
# -fno-tree-pre keeps constants in registers.
compile_core(-fno-tree-pre device/read_dots.cpp core/detect/tiles.cpp)
# -fno-tree-pre saves 32 bytes, because it keeps GCC from moving computations to earlier code.
compile_core(-fno-tree-pre device/grow.cpp)
