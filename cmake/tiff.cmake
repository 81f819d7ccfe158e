# Defines TIFF::TIFF. A static libtiff also needs the libraries that it uses, which CMake does not know.
find_package(TIFF QUIET)
if(TARGET TIFF::TIFF AND TIFF_LIBRARY MATCHES "[.]a$")
    find_package(JPEG QUIET)
    find_package(ZLIB QUIET)
    target_link_libraries(TIFF::TIFF INTERFACE JPEG::JPEG ZLIB::ZLIB)
endif()
