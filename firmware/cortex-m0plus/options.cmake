# What runs once a frame is made small, so that the code fits.
set(once code/basis.cpp code/decode.cpp code/encode.cpp core/locate.cpp core/plane.cpp
         core/attempts/device.cpp core/attempts/device_tracked.cpp core/attempts/steps.cpp
         core/decode/confidence.cpp core/decode/contest.cpp core/decode/orientation.cpp
         core/decode/position.cpp core/decode/seam_rivals.cpp core/decode/unshared_lines.cpp
         core/decode/verify.cpp core/decode/window.cpp core/detect/undistort.cpp core/lattice/predicted.cpp
         core/lattice/turn.cpp core/pose/subgrid.cpp)
list(TRANSFORM once PREPEND ${PROJECT_SOURCE_DIR}/src/)
set_source_files_properties(${once} TARGET_DIRECTORY dotpose_code dotpose_core
                            PROPERTIES COMPILE_OPTIONS -Os)
