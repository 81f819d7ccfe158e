// TIFF writer for a build without libtiff. It throws Error.
#include "writers.hpp"

namespace dotpose::print {

void write_tiff(RasterSize, double, const png::RowSource&, base::OutputFile&) {
    throw Error("cannot write TIFF: dotpose was built without libtiff");
}

}  // namespace dotpose::print
