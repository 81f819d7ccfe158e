# Uses only the modules of OpenCV that dotpose-live requires. OpenCV's CMake files are only in
# Debian's package of the complete OpenCV, which is ten times larger.
find_path(DOTPOSE_OPENCV_INCLUDE opencv2/videoio.hpp PATH_SUFFIXES opencv4)
set(libraries)
foreach(part IN ITEMS videoio highgui imgproc core)
    find_library(DOTPOSE_OPENCV_${part} opencv_${part})
    list(APPEND libraries ${DOTPOSE_OPENCV_${part}})
endforeach()
if(DOTPOSE_OPENCV_INCLUDE AND NOT libraries MATCHES "NOTFOUND")
    add_library(dotpose_opencv INTERFACE)
    # The directory is SYSTEM, because the headers of OpenCV do not compile without warnings.
    target_include_directories(dotpose_opencv SYSTEM INTERFACE ${DOTPOSE_OPENCV_INCLUDE})
    target_link_libraries(dotpose_opencv INTERFACE ${libraries})
endif()
