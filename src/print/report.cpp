#include "writers.hpp"

namespace dotpose::print {

void report(const Progress& progress, int rows_done, int rows) {
    if (progress && !progress(rows_done, rows)) throw Error("stopped; nothing was written");
}

}  // namespace dotpose::print
