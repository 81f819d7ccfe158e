# Only the parts of OpenCV that live use needs: Debian's package of all of it, which alone has the
# CMake files, is ten times as large.
find_path(DOTPOSE_OPENCV_INCLUDE opencv2/videoio.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(dotpose_opencv INTERFACE)
# SYSTEM: its headers do not compile without warnings.
target_include_directories(dotpose_opencv SYSTEM INTERFACE ${DOTPOSE_OPENCV_INCLUDE})
foreach(part IN ITEMS videoio highgui imgproc core)
    find_library(DOTPOSE_OPENCV_${part} opencv_${part} REQUIRED)
    target_link_libraries(dotpose_opencv INTERFACE ${DOTPOSE_OPENCV_${part}})
endforeach()
