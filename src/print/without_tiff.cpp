// TIFF writer for builds without libtiff. Always throws Error.
#include "writers.hpp"

namespace dotpose::print {

void write_tiff(RasterSize, double, const png::RowSource&, base::OutputFile&) {
    throw Error("cannot write TIFF: dotpose was built without libtiff");
}

}  // namespace dotpose::print
