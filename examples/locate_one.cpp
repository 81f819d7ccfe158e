// Prints where an image looks on the pattern: dotpose_locate_one IMAGE
#include <cstdio>
#include <exception>

#include <dotpose/tools/heap_locator.hpp>
#include <dotpose/tools/image_file.hpp>

int main(int argc, char** argv) try {
    if (argc != 2) return 2;
    const dotpose::Fix fix = dotpose::HeapLocator().locate(dotpose::read_image(argv[1]).view());
    if (fix.status != dotpose::Status::ok) return std::puts(dotpose::message(fix.status)), 1;
    std::printf("x %.3f mm, y %.3f mm, angle %.4f rad\n", fix.x_mm(), fix.y_mm(), fix.theta_rad());
} catch (const std::exception& problem) {
    return std::fprintf(stderr, "%s\n", problem.what()), 1;
}
