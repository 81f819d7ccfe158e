include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dotpose)
# Relative, so that `cmake --install --prefix` and a moved tree stay right.
file(RELATIVE_PATH DOTPOSE_PREFIX_FROM_PC
     /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" DOTPOSE_PREFIX_FROM_PC "${DOTPOSE_PREFIX_FROM_PC}")

# Who links the static library links what it uses; a shared one brings that along.
if(NOT BUILD_SHARED_LIBS)
    set(DOTPOSE_FILES_PC_REQUIRES ", yaml-cpp")
    set(DOTPOSE_PC_REQUIRES
        ", libpng, libtiff-4, fmt, GraphicsMagick, librsvg-2.0, libqpdf")
    set(DOTPOSE_PC_LIBS " -lceres -lglog -pthread")
endif()

# A header without its library would only fail when the user links.
set(without)
foreach(library IN ITEMS files tools)
    string(TOUPPER ${library} upper)
    if(NOT DOTPOSE_BUILD_${upper})
        list(APPEND without PATTERN ${library} EXCLUDE)
    endif()
endforeach()
install(DIRECTORY include/dotpose TYPE INCLUDE FILES_MATCHING PATTERN "*.hpp" ${without})

if(TARGET dotpose_c)
    install(FILES wrappers/c/dotpose.h TYPE INCLUDE)
endif()

# An export set each: who only wants the core must not need yaml-cpp, nor libpng, to be found.
foreach(target IN ITEMS dotpose dotpose_c dotpose_files dotpose_tools)
    if(TARGET ${target})
        install(TARGETS ${target} EXPORT ${target}
                ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
                LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
        install(EXPORT ${target} NAMESPACE dotpose:: DESTINATION ${config_dir}
                FILE ${target}Targets.cmake)
        string(REPLACE _ - pc_name ${target})
        configure_file(cmake/${pc_name}.pc.in ${pc_name}.pc @ONLY)
        install(FILES ${PROJECT_BINARY_DIR}/${pc_name}.pc
                DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
    endif()
endforeach()
if(TARGET dotpose_cli)
    install(TARGETS dotpose_cli)
    # The schema of the lines that the tool writes.
    install(DIRECTORY docs/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/dotpose)
endif()
if(TARGET dotpose_live_cli)
    install(TARGETS dotpose_live_cli DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/dotpose)
endif()

# The documents link to each other, so they lie there as in the source.
install(FILES README.md CONTRIBUTING.md LICENSE TYPE DOC)
install(DIRECTORY docs TYPE DOC)
install(DIRECTORY examples TYPE DOC FILES_MATCHING PATTERN "*.cpp")
install(FILES wrappers/c/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/wrappers/c)
install(DIRECTORY wrappers/c/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/wrappers/c)

configure_package_config_file(cmake/dotposeConfig.cmake.in dotposeConfig.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(dotposeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dotposeConfig.cmake
              ${PROJECT_BINARY_DIR}/dotposeConfigVersion.cmake
        DESTINATION ${config_dir})
