#include <fmt/core.h>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "pdf_dots.hpp"
#include "pdf_file.hpp"
#include "pdf_labels.hpp"
#include "writers.hpp"

namespace dotpose::print {
namespace {

QPDFObjectHandle make_page(QPDF& pdf, const Paper& paper,
                           const std::vector<QPDFObjectHandle>& contents,
                           const QPDFObjectHandle& resources) {
    QPDFObjectHandle page = QPDFObjectHandle::parse(
        fmt::format("<< /Type /Page /MediaBox [0 0 {:.4f} {:.4f}] >>",
                    paper.width_mm * kPointsPerMm, paper.height_mm * kPointsPerMm));
    page.replaceKey("/Contents", QPDFObjectHandle::newArray(contents));
    page.replaceKey("/Resources", resources);
    return pdf.makeIndirectObject(page);
}

std::string mark_content(const PrintPage& page) {
    std::string content = "0 0 0 1 k\n";
    for (const InkRectangle& mark : page.marks) {
        content += fmt::format("{:.4f} {:.4f} {:.4f} {:.4f} re\n", mark.x_mm * kPointsPerMm,
                               (page.height_mm - mark.y_mm - mark.height_mm) * kPointsPerMm,
                               mark.width_mm * kPointsPerMm, mark.height_mm * kPointsPerMm);
    }
    return content + "f\n";
}

void set_information(QPDF& pdf, const std::string& title) {
    QPDFObjectHandle info = QPDFObjectHandle::newDictionary();
    if (!title.empty()) info.replaceKey("/Title", QPDFObjectHandle::newUnicodeString(title));
    info.replaceKey("/Creator", QPDFObjectHandle::newString(kCreator));
    // This setting prevents print dialogs from scaling pages by default.
    pdf.getRoot().replaceKey("/ViewerPreferences",
                             QPDFObjectHandle::parse("<< /PrintScaling /None >>"));
    pdf.getTrailer().replaceKey("/Info", pdf.makeIndirectObject(info));
}

}  // namespace

void write_pdf(std::span<const Sheet> sheets, const PrintOptions& options, base::OutputFile& file) {
    QPDF pdf;
    pdf.emptyPDF();
    const auto rows = std::make_shared<RowCount>();
    rows->progress = options.progress;
    DotContent dots(pdf, options.dpi, options.drawing, rows);
    ScriptText script(pdf);
    QPDFObjectHandle label_font;
    if (options.labels) {
        label_font = pdf.makeIndirectObject(QPDFObjectHandle::parse(
            "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>"));
    }
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const Sheet& sheet = sheets[i];
        const PageNumber number{
            options.first_page + static_cast<int>(i),
            options.page_count > 0 ? options.page_count : static_cast<int>(sheets.size())};
        std::vector<QPDFObjectHandle> contents = dots.streams(sheet);
        QPDFObjectHandle resources = dots.resources(sheet);
        if (options.labels) {
            PrintOptions of_page = options;
            if (!options.page_commands.empty()) of_page.command = options.page_commands.at(i);
            contents.push_back(
                QPDFObjectHandle::newStream(&pdf, label_content(sheet, number, of_page, script)));
            script.add_to(resources);
            if (!resources.hasKey("/Font")) {
                resources.replaceKey("/Font", QPDFObjectHandle::newDictionary());
            }
            resources.getKey("/Font").replaceKey("/Label", label_font);
        }
        QPDFPageDocumentHelper(pdf).addPage(
            make_page(pdf, {sheet.width_mm, sheet.height_mm}, contents, resources), false);
    }
    set_information(pdf, options.name);
    write_document(pdf, *rows, file);
}

void write_pdf_page(const PrintPage& page, const PrintOptions& options, base::OutputFile& file) {
    QPDF pdf;
    pdf.emptyPDF();
    const auto rows = std::make_shared<RowCount>();
    rows->progress = options.progress;
    DotContent dots(pdf, options.dpi, options.drawing, rows);
    std::string content = mark_content(page);
    QPDFObjectHandle forms = QPDFObjectHandle::newDictionary();
    int count = 0;
    for (const Sheet& sheet : page.sheets) {
        for (const QPDFObjectHandle& form : dots.forms(sheet)) {
            const std::string name = fmt::format("{}{}", kDotsName, ++count);
            forms.replaceKey(name, form);
            content += name + " Do\n";
        }
    }
    QPDFObjectHandle resources = QPDFObjectHandle::newDictionary();
    resources.replaceKey("/XObject", forms);
    QPDFPageDocumentHelper(pdf).addPage(
        make_page(pdf, {page.width_mm, page.height_mm},
                  {QPDFObjectHandle::newStream(&pdf, content)}, resources),
        false);
    set_information(pdf, options.name);
    write_document(pdf, *rows, file);
}

}  // namespace dotpose::print
