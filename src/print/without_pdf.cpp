// PDF writers for builds without qpdf. They always throw Error.
#include "writers.hpp"

namespace dotpose::print {

void write_pdf(std::span<const Sheet>, const PrintOptions&, base::OutputFile&) {
    throw Error("cannot write PDF: dotpose was built without qpdf");
}

void write_pdf_page(const PrintPage&, const PrintOptions&, base::OutputFile&) {
    throw Error("cannot write PDF: dotpose was built without qpdf");
}

}  // namespace dotpose::print
