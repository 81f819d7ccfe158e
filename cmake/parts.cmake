# Declares the parts of dotpose other than the core, and the libraries that they need. Only this
# file searches for libraries, and only for those that a part needs.

if(PROJECT_IS_TOP_LEVEL)
    set(default FOUND)
else()
    set(default CORE)
endif()
set(DOTPOSE_PARTS ${default} CACHE STRING
    "Parts to build: CORE (none but the core), FOUND (those whose libraries are found), ALL (a missing library is an error)")
set_property(CACHE DOTPOSE_PARTS PROPERTY STRINGS CORE FOUND ALL)

# dotpose_dependency(TARGET DEBIAN package (PACKAGE name | MODULES module... | FILE file)): declares
# a library that parts may need, and how to find it: with find_package, with pkg-config, or with a
# file in cmake/ that defines the target.
macro(dotpose_dependency target)
    set(dotpose_how_${target} ${ARGN})
endmacro()

#                  target                    Debian's package              how it is found
dotpose_dependency(fmt::fmt                  libfmt-dev                    FILE fmt.cmake)
dotpose_dependency(nlohmann_json::nlohmann_json nlohmann-json3-dev         PACKAGE nlohmann_json)
dotpose_dependency(PkgConfig::YamlCpp        libyaml-cpp-dev               MODULES yaml-cpp)
dotpose_dependency(PNG::PNG                  libpng-dev                    PACKAGE PNG)
dotpose_dependency(TIFF::TIFF                libtiff-dev                   FILE tiff.cmake)
dotpose_dependency(JPEG::JPEG                libjpeg-dev                   PACKAGE JPEG)
dotpose_dependency(PkgConfig::Exif           libexif-dev                   MODULES libexif)
dotpose_dependency(PkgConfig::WebP           libwebp-dev                   MODULES libwebp libwebpdemux)
dotpose_dependency(PkgConfig::Heif           libheif-dev                   MODULES libheif)
dotpose_dependency(PkgConfig::Qpdf           libqpdf-dev                   MODULES libqpdf)
dotpose_dependency(PkgConfig::Rsvg           librsvg2-dev                  MODULES librsvg-2.0)
dotpose_dependency(Eigen3::Eigen             libeigen3-dev                 PACKAGE Eigen3)
dotpose_dependency(Ceres::ceres              libceres-dev                  PACKAGE Ceres)
dotpose_dependency(CLI11::CLI11              libcli11-dev                  PACKAGE CLI11)
dotpose_dependency(simdjson::simdjson        libsimdjson-dev               PACKAGE simdjson)
dotpose_dependency(dotpose_opencv            libopencv-{videoio,highgui,imgproc}-dev FILE opencv.cmake)
dotpose_dependency(PkgConfig::FFmpeg         libav{format,codec}-dev,\ libswscale-dev
                                             MODULES libavformat libavcodec libavutil libswscale)
dotpose_dependency(PkgConfig::Mosquitto      libmosquitto-dev              MODULES libmosquitto)
dotpose_dependency(PkgConfig::Websockets     libwebsockets-dev             MODULES libwebsockets)
dotpose_dependency(esbuild                   esbuild                       FILE esbuild.cmake)
dotpose_dependency(PkgConfig::Sqlite         libsqlite3-dev                MODULES sqlite3)
dotpose_dependency(PkgConfig::Postgres       libpq-dev                     MODULES libpq)
dotpose_dependency(CycloneDDS::ddsc          cyclonedds-dev                PACKAGE CycloneDDS)
dotpose_dependency(CycloneDDS::idlc          cyclonedds-tools              FILE idlc.cmake)
dotpose_dependency(Threads::Threads          libc6-dev                     PACKAGE Threads)
dotpose_dependency(GTest::gmock_main         libgtest-dev,\ libgmock-dev   PACKAGE GTest)
dotpose_dependency(benchmark::benchmark      libbenchmark-dev              PACKAGE benchmark)
dotpose_dependency(PkgConfig::Apriltag       libapriltag-dev               MODULES apriltag)

# dotpose_find(TARGET): searches for the library, unless it has already been searched for. This is a macro
# because find modules set variables in the caller's scope.
macro(dotpose_find target)
    if(NOT TARGET ${target})
        list(GET dotpose_how_${target} 1 dotpose_kind)
        list(SUBLIST dotpose_how_${target} 2 -1 dotpose_names)
        if(dotpose_kind STREQUAL "PACKAGE")
            find_package(${dotpose_names} QUIET)
        elseif(dotpose_kind STREQUAL "FILE")
            include(${PROJECT_SOURCE_DIR}/cmake/${dotpose_names})
        else()
            string(REPLACE "PkgConfig::" "" dotpose_prefix ${target})
            find_package(PkgConfig QUIET)
            if(PkgConfig_FOUND)
                pkg_check_modules(${dotpose_prefix} QUIET IMPORTED_TARGET ${dotpose_names})
            endif()
        endif()
    endif()
endmacro()

# dotpose_part(NAME "description" SETUP group [NEEDS target...] [PARTS part...]): declares a part, and the
# libraries and earlier parts that it needs. The option DOTPOSE_WITH_NAME is ON (a missing library is an
# error), OFF, or empty. If it is empty, DOTPOSE_PARTS decides, and parts that another part needs are ON.
# SETUP: the group of scripts/setup that installs the libraries.
set(parts)
macro(dotpose_part name what)
    cmake_parse_arguments(${name} "" "SETUP" "NEEDS;PARTS" ${ARGN})
    set(${name}_what ${what})
    set(DOTPOSE_WITH_${name} "" CACHE STRING "Build ${what}: ON, OFF, empty: see DOTPOSE_PARTS")
    set(${name}_wanted "${DOTPOSE_WITH_${name}}")
    list(APPEND parts ${name})
endmacro()

# dotpose_decide(NAME): sets DOTPOSE_HAS_NAME for a part. If the part is not built, prints the
# reason.
macro(dotpose_decide name)
    set(missing)
    foreach(needed IN LISTS ${name}_PARTS)
        if(NOT DOTPOSE_HAS_${needed})
            list(APPEND missing "DOTPOSE_WITH_${needed}")
        endif()
    endforeach()
    foreach(needed IN LISTS ${name}_NEEDS)
        dotpose_find(${needed})
        if(NOT TARGET ${needed})
            list(GET dotpose_how_${needed} 0 package)
            list(APPEND missing "${package}")
        endif()
    endforeach()
    set(DOTPOSE_HAS_${name} ON)
    if(missing)
        set(DOTPOSE_HAS_${name} OFF)
        list(JOIN missing ", " missing)
        set(text "${${name}_what}: missing ${missing} (scripts/setup ${${name}_SETUP})")
        if(${name}_wanted)
            message(FATAL_ERROR "Cannot build ${text}")
        endif()
        message(STATUS "Left out: ${text}")
    endif()
endmacro()

dotpose_part(BASE      "sheets as values" SETUP core NEEDS fmt::fmt)
dotpose_part(SIMULATE  "the simulated camera" SETUP core)
dotpose_part(RSVG      "labels of PDF pages in any script, and plots as PNG" SETUP tools
             PARTS BASE NEEDS PkgConfig::Rsvg)
dotpose_part(PNG       "writing PNG" SETUP core PARTS BASE NEEDS PNG::PNG)
dotpose_part(PRINT     "printing: PNG, SVG, text" SETUP core PARTS PNG)
dotpose_part(DRAW      "pictures of what was read" SETUP core PARTS PNG)
dotpose_part(FILES     "sheet and camera files" SETUP tools
             PARTS BASE NEEDS PkgConfig::YamlCpp nlohmann_json::nlohmann_json)
dotpose_part(TIFF      "printing: TIFF" SETUP tools PARTS PRINT NEEDS TIFF::TIFF)
dotpose_part(PDF       "printing: PDF, and dots over PDF documents" SETUP tools
             PARTS PRINT NEEDS PkgConfig::Qpdf nlohmann_json::nlohmann_json)
dotpose_part(IMAGES    "image files" SETUP tools
             PARTS PNG NEEDS JPEG::JPEG TIFF::TIFF PkgConfig::Exif)
dotpose_part(WEBP      "reading WebP" SETUP tools PARTS IMAGES NEEDS PkgConfig::WebP)
dotpose_part(HEIF      "reading HEIC and AVIF" SETUP tools PARTS IMAGES NEEDS PkgConfig::Heif)
dotpose_part(EVALUATE  "evaluation" SETUP tools PARTS DRAW IMAGES SIMULATE)
dotpose_part(CALIBRATE "calibration and the check of prints" SETUP tools
             PARTS FILES PRINT NEEDS Eigen3::Eigen Ceres::ceres)
dotpose_part(FOLLOW    "following over sheets" SETUP tools PARTS CALIBRATE)
dotpose_part(ROBOTS    "messages and recordings of ROS" SETUP tools PARTS FOLLOW)
dotpose_part(TOOL      "the program dotpose" SETUP tools
             PARTS TIFF PDF EVALUATE ROBOTS NEEDS CLI11::CLI11 Threads::Threads)
dotpose_part(LIVE      "dotpose watch and fleet" SETUP live
             PARTS TOOL
             NEEDS dotpose_opencv PkgConfig::FFmpeg PkgConfig::Mosquitto simdjson::simdjson)
dotpose_part(SQLITE    "dotpose fleet --store FILE" SETUP live PARTS LIVE NEEDS PkgConfig::Sqlite)
dotpose_part(POSTGRES  "dotpose fleet --store postgresql://..." SETUP live
             PARTS LIVE NEEDS PkgConfig::Postgres)
dotpose_part(DDS       "dotpose watch --dds" SETUP robots
             PARTS LIVE NEEDS CycloneDDS::ddsc CycloneDDS::idlc)
dotpose_part(WEB       "the page of dotpose watch --web" SETUP live
             PARTS LIVE NEEDS PkgConfig::Websockets esbuild)
# The fuzz preset excludes the parts for calibration and live use, which take minutes to build and
# have no fuzz targets.
set(tested LIVE)
if(DOTPOSE_SANITIZE MATCHES "fuzzer")
    set(tested TIFF PDF FILES EVALUATE)
    dotpose_find(CLI11::CLI11)
    dotpose_find(Eigen3::Eigen)
    dotpose_find(simdjson::simdjson)
endif()
dotpose_part(TESTS     "the tests" SETUP tests
             PARTS ${tested} NEEDS GTest::gmock_main)
dotpose_part(BENCH     "the benchmarks" SETUP bench
             PARTS TOOL NEEDS benchmark::benchmark PkgConfig::Apriltag)

list(REVERSE parts)
foreach(part IN LISTS parts)
    if(${part}_wanted STREQUAL "" AND DOTPOSE_PARTS STREQUAL "ALL")
        set(${part}_wanted ON)
    endif()
    if(${part}_wanted)
        foreach(needed IN LISTS ${part}_PARTS)
            if(${needed}_wanted STREQUAL "")
                set(${needed}_wanted ON)
            endif()
        endforeach()
    elseif(${part}_wanted STREQUAL "" AND DOTPOSE_PARTS STREQUAL "CORE")
        set(${part}_wanted OFF)
    endif()
endforeach()
list(REVERSE parts)
foreach(part IN LISTS parts)
    set(DOTPOSE_HAS_${part} OFF)
    if(${part}_wanted STREQUAL "" OR ${part}_wanted)
        dotpose_decide(${part})
    endif()
endforeach()
