# Defines TIFF::TIFF. CMake's module does not list the libraries that a static libtiff requires, so
# they are added here.
find_package(TIFF QUIET)
if(TARGET TIFF::TIFF AND TIFF_LIBRARY MATCHES "[.]a$")
    find_package(JPEG QUIET)
    find_package(ZLIB QUIET)
    target_link_libraries(TIFF::TIFF INTERFACE JPEG::JPEG ZLIB::ZLIB)
endif()
