#include "pdf_file.hpp"

#include <fmt/core.h>
#include <qpdf/QPDFWriter.hh>

namespace dotpose::print {
namespace {

/// Makes the writer copy compressed streams unchanged. Unpacking them could take unlimited time and
/// memory.
void keep_packed(QPDF& pdf) {
    for (QPDFObjectHandle object : pdf.getAllObjects()) {
        if (object.isStream() && object.getDict().hasKey("/Filter") && !object.isDataModified()) {
            object.setFilterOnWrite(false);
        }
    }
}

}  // namespace

void write_document(QPDF& pdf, const RowCount& rows, base::OutputFile& file) {
    FilePipeline out(file);
    try {
        keep_packed(pdf);
        QPDFWriter writer(pdf);
        writer.setOutputPipeline(&out);
        writer.setObjectStreamMode(qpdf_o_generate);
        // With a deterministic identifier, identical input produces identical files. This is not
        // possible for encrypted files, whose key depends on a random identifier.
        if (!pdf.isEncrypted()) writer.setDeterministicID(true);
        writer.write();
    } catch (const std::exception& error) {
        if (rows.stopped) std::rethrow_exception(rows.stopped);
        if (dynamic_cast<const Error*>(&error) != nullptr) throw;
        throw Error(fmt::format("cannot write PDF: {}", error.what()));
    }
}

}  // namespace dotpose::print
