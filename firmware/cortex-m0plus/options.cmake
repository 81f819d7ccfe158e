# Functions that run once per frame are optimized for size, so that the code fits.
compile_core(-Os code/basis.cpp code/decode.cpp code/encode.cpp core/locate.cpp core/plane.cpp
             core/attempts/device.cpp core/attempts/device_tracked.cpp core/attempts/steps.cpp
             core/decode/confidence.cpp core/decode/contest.cpp core/decode/orientation.cpp
             core/decode/position.cpp core/decode/seam_rivals.cpp core/decode/unshared_lines.cpp
             core/decode/verify.cpp core/decode/window.cpp core/detect/undistort.cpp
             core/lattice/predicted.cpp core/lattice/turn.cpp core/pose/subgrid.cpp
             core/pose/tracked_pose.cpp)
