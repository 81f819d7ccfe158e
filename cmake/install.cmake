include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dotpose)
# The prefix in pkg-config files is relative. It remains correct after `cmake --install --prefix`
# and if the tree is moved.
file(RELATIVE_PATH DOTPOSE_PREFIX_FROM_PC
     /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" DOTPOSE_PREFIX_FROM_PC "${DOTPOSE_PREFIX_FROM_PC}")

# Programs that link the static libraries must also link the dependencies of these libraries. Shared libraries
# load their own dependencies.
set(DOTPOSE_PC_FILES)
set(DOTPOSE_PC_TOOLS)
set(DOTPOSE_PC_TOOLS_LIBS)
foreach(part IN LISTS DOTPOSE_LIBRARIES)
    if(NOT part MATCHES "^(base|files)$")
        string(PREPEND DOTPOSE_PC_TOOLS_LIBS " -ldotpose_${part}")
    endif()
endforeach()
if(NOT BUILD_SHARED_LIBS)
    set(DOTPOSE_PC_FILES ", yaml-cpp, fmt")
    set(DOTPOSE_PC_TOOLS ", libpng, libjpeg, libtiff-4, libexif, libqpdf")
    if(DOTPOSE_HAS_RSVG)
        string(APPEND DOTPOSE_PC_TOOLS ", librsvg-2.0")
    endif()
    if(DOTPOSE_HAS_WEBP)
        string(APPEND DOTPOSE_PC_TOOLS ", libwebp, libwebpdemux")
    endif()
    if(DOTPOSE_HAS_HEIF)
        string(APPEND DOTPOSE_PC_TOOLS ", libheif")
    endif()
    string(APPEND DOTPOSE_PC_TOOLS_LIBS " -lceres -lglog -pthread")
endif()

# Headers whose library is not built are not installed. Otherwise, a program that includes one of these
# headers would fail only at link time.
set(without)
if(NOT DOTPOSE_HAS_FILES)
    list(APPEND without PATTERN files EXCLUDE)
endif()
if(NOT DOTPOSE_HAS_TOOL)
    list(APPEND without PATTERN tools EXCLUDE)
endif()
install(DIRECTORY include/dotpose TYPE INCLUDE FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def" ${without})

if(TARGET dotpose_c)
    install(FILES wrappers/c/dotpose.h TYPE INCLUDE)
endif()
if(TARGET dotpose_c_space)
    install(FILES wrappers/c/space/dotpose_print_map.h wrappers/c/space/dotpose_space.h TYPE INCLUDE)
endif()

# Each library has its own export set. Users of the core alone then do not need yaml-cpp or libpng.
set(libraries dotpose dotpose_c)
list(TRANSFORM DOTPOSE_LIBRARIES PREPEND dotpose_ OUTPUT_VARIABLE libraries_of_parts)
list(APPEND libraries ${libraries_of_parts})
if(TARGET dotpose_c_space)
    list(APPEND libraries dotpose_c_space)
endif()
if(DOTPOSE_HAS_TOOL)
    list(APPEND libraries dotpose_tools)
endif()
foreach(target IN LISTS libraries)
    install(TARGETS ${target} EXPORT ${target}
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT ${target} NAMESPACE dotpose:: DESTINATION ${config_dir}
            FILE ${target}Targets.cmake)
    string(REPLACE _ - pc_name ${target})
    if(EXISTS ${PROJECT_SOURCE_DIR}/cmake/${pc_name}.pc.in)
        configure_file(cmake/${pc_name}.pc.in ${pc_name}.pc @ONLY)
        install(FILES ${PROJECT_BINARY_DIR}/${pc_name}.pc
                DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
    endif()
endforeach()
if(TARGET dotpose_cli)
    install(TARGETS dotpose_cli)
    # Schema of the JSON lines that the tool writes.
    install(DIRECTORY docs/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/dotpose)
endif()
if(TARGET dotpose_live_cli)
    install(TARGETS dotpose_live_cli dotpose_video_module DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/dotpose)
    # Prometheus alert rules and Grafana dashboard for `dotpose fleet --metrics`.
    install(DIRECTORY packaging/monitoring DESTINATION ${CMAKE_INSTALL_DATADIR}/dotpose)
endif()

# The documents link to each other, so they are installed with the same layout as in the source
# tree.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE TYPE DOC)
install(DIRECTORY docs TYPE DOC)
install(DIRECTORY examples TYPE DOC FILES_MATCHING PATTERN "*.cpp")
install(FILES wrappers/c/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/wrappers/c)
install(DIRECTORY wrappers/c/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/wrappers/c)

set(DOTPOSE_PRINT_NEEDS)
if(DOTPOSE_HAS_TIFF)
    string(APPEND DOTPOSE_PRINT_NEEDS " TIFF")
endif()
if(DOTPOSE_HAS_PDF)
    string(APPEND DOTPOSE_PRINT_NEEDS " Qpdf=libqpdf")
endif()
set(DOTPOSE_EVALUATE_NEEDS)
if(DOTPOSE_HAS_RSVG)
    string(APPEND DOTPOSE_PRINT_NEEDS " Rsvg=librsvg-2.0")
    string(APPEND DOTPOSE_EVALUATE_NEEDS " Rsvg=librsvg-2.0")
endif()
set(DOTPOSE_IMAGES_NEEDS)
if(DOTPOSE_HAS_WEBP)
    string(APPEND DOTPOSE_IMAGES_NEEDS " WebP=libwebp,libwebpdemux")
endif()
if(DOTPOSE_HAS_HEIF)
    string(APPEND DOTPOSE_IMAGES_NEEDS " Heif=libheif")
endif()
list(REMOVE_ITEM DOTPOSE_LIBRARIES base png)
list(JOIN DOTPOSE_LIBRARIES " " DOTPOSE_COMPONENTS)
if(TARGET dotpose_c_space)
    string(APPEND DOTPOSE_COMPONENTS " c_space")
endif()
if(DOTPOSE_HAS_TOOL)
    string(APPEND DOTPOSE_COMPONENTS " tools")
endif()
configure_package_config_file(cmake/dotposeConfig.cmake.in dotposeConfig.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(dotposeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dotposeConfig.cmake
              ${PROJECT_BINARY_DIR}/dotposeConfigVersion.cmake
        DESTINATION ${config_dir})
