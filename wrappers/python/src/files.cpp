// Bindings for the functions that read and write image files.
#include "binding.hpp"
#include "dotpose/tools/image_file.hpp"
#include "image.hpp"
#include "progress.hpp"

namespace dotpose::python {

void define_files(py::module_& module) {
    module.def(
        "read_image",
        [](const std::filesystem::path& path) {
            return array_of(without_lock([&] { return read_image(path); }));
        },
        "path"_a,
        "Read a PNM, PNG, JPEG, BMP, TIFF, WebP or HEIC file. Return an array of uint8, height x "
        "width, 0 is black. Colours are converted to grey.");
    module.def(
        "write_image",
        [](const std::filesystem::path& path, const py::object& image) {
            const ImageView view = view_of(image);
            if (path.extension() == ".pgm") return write_pgm(path, view);
            if (path.extension() == ".png") return write_png(path, view);
            throw BadArgument(path.string() + ": must end in .png or .pgm");
        },
        "path"_a, "image"_a, "Write an image as .png or .pgm.");
}

}  // namespace dotpose::python
