/// Writes a qpdf document through an OutputFile, so that no incomplete file remains if writing
/// fails.
#pragma once

#include <qpdf/Pipeline.hh>
#include <qpdf/QPDF.hh>

#include "base/output_file.hpp"
#include "pdf_dots.hpp"

namespace dotpose::print {

class FilePipeline : public Pipeline {
  public:
    explicit FilePipeline(base::OutputFile& file) : Pipeline("output file", nullptr), file_(file) {}

    void write(unsigned char const* data, std::size_t size_bytes) override {
        file_.write(data, size_bytes);
        file_.require_good();
    }
    void finish() override {}

  private:
    base::OutputFile& file_;
};

/// Writes `pdf` to `file` without committing the file. Throws the exception stored in `rows`, or
/// Error if the file cannot be written or qpdf fails.
void write_document(QPDF& pdf, const RowCount& rows, base::OutputFile& file);

}  // namespace dotpose::print
