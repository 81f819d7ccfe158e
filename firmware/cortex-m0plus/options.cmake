# Functions that run once per frame are optimized for size, so that the code fits.
compile_core(-Os code/basis.cpp code/decode.cpp code/encode.cpp core/locate_device.cpp core/math/plane.cpp
             core/attempts/device.cpp core/attempts/device_tracked.cpp core/attempts/steps.cpp
             core/integrity/confidence.cpp core/integrity/likelihood_ratios.cpp core/decode/orientation.cpp
             core/decode/position.cpp core/integrity/seam_alternatives.cpp core/integrity/unshared_lines.cpp
             core/integrity/verify.cpp core/decode/window.cpp core/detect/undistort.cpp
             core/lattice/predicted.cpp core/lattice/turn.cpp core/pose/subgrid.cpp
             core/pose/tracked_pose.cpp)
