#include "pdf_file.hpp"

#include <fmt/core.h>
#include <qpdf/QPDFWriter.hh>

namespace dotpose::print {

void write_document(QPDF& pdf, const RowCount& rows, OutputFile& file) {
    FilePipeline out(file);
    try {
        QPDFWriter writer(pdf);
        writer.setOutputPipeline(&out);
        writer.setObjectStreamMode(qpdf_o_generate);
        // The same input gives the same file; the key of an encrypted one depends on its random id.
        if (!pdf.isEncrypted()) writer.setDeterministicID(true);
        writer.write();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        if (rows.stopped) std::rethrow_exception(rows.stopped);
        throw Error(fmt::format("cannot write PDF: {}", error.what()));
    }
}

}  // namespace dotpose::print
