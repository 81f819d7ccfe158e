# Functions that run once per frame are optimized for size, to fit into the flash memory.
compile_core(-Os code/basis.cpp code/decode.cpp code/encode.cpp device/locate.cpp core/row_locator.cpp core/math/plane.cpp
             device/attempt.cpp device/in_whole_code.cpp device/tracked.cpp core/steps.cpp
             core/integrity/confidence.cpp core/integrity/likelihood_ratios.cpp core/decode/orientation.cpp
             core/decode/position.cpp core/integrity/seam_alternatives.cpp core/integrity/unshared_lines.cpp
             core/integrity/verify.cpp core/decode/window.cpp core/detect/undistort.cpp
             device/predicted.cpp device/turn.cpp core/pose/subgrid.cpp
             device/tracked_pose.cpp)
