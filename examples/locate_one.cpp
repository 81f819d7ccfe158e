// Prints where an image looks on the pattern: dotpose_locate_one IMAGE
#include <cstdio>
#include <memory>

#include <dotpose/locate.hpp>
#include <dotpose/tools/image_file.hpp>

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const dotpose::GreyImage image = dotpose::read_image(argv[1]);
    const auto workspace = std::make_unique<dotpose::LargeWorkspace>();
    const dotpose::Fix fix = dotpose::locate(image.view(), {}, *workspace);
    if (fix.status != dotpose::Status::ok) return std::puts(dotpose::message(fix.status)), 1;
    std::printf("x %.3f mm, y %.3f mm, angle %.4f rad\n", fix.x_mm(0.508), fix.y_mm(0.508),
                fix.theta_rad());
}
