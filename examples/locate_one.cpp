// Locates one image, and prints its position and angle in the pattern: dotpose_locate_one FRAME.pgm
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <dotpose/dotpose.hpp>

int main(int argc, char** argv) {
    if (argc != 2) return std::fputs("usage: locate_one FRAME.pgm\n", stderr), 2;
    // Reads a binary PGM file: the width, the height and the maximum grey level as text, then one
    // byte per pixel.
    std::ifstream file(argv[1], std::ios::binary);
    std::string kind;
    int width = 0;
    int height = 0;
    int white = 0;
    file >> kind >> width >> height >> white;
    file.get();
    const bool is_pgm =
        kind == "P5" && white == 255 && width > 0 && width <= 4096 && height > 0 && height <= 4096;
    std::vector<std::uint8_t> pixels(is_pgm ? width * height : 0);
    if (!file.read(reinterpret_cast<char*>(pixels.data()), pixels.size()) || pixels.empty())
        return std::fprintf(stderr, "cannot read %s as a PGM of 8 bits\n", argv[1]), 1;

    dotpose::Locator locator;
    const dotpose::Fix fix = locator.locate({pixels.data(), width, height, width});
    if (!fix) return std::puts(dotpose::message(fix.status)), 1;
    std::printf("x %.3f mm, y %.3f mm, angle %.4f rad\n", fix.x_mm(), fix.y_mm(), fix.theta_rad());
}
