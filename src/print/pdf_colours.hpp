/// Rewrites the colours in the content of a page and in copies of all objects that the content
/// draws.
#pragma once

#include <map>
#include <set>
#include <string>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageObjectHelper.hh>

#include "pdf_ink.hpp"
#include "pdf_limits.hpp"

namespace dotpose::print {

/// Converts the colours of pages. Leaves the original objects unchanged and creates converted
/// copies, which all converted pages share. Pages that are not converted keep the originals.
/// Streams are rewritten only while the file is written.
class ColourConverter {
  public:
    /// `unpacked` counts the unpacked bytes of all converted content. It must outlive this object.
    ColourConverter(InkChange change, UnpackedBytes& unpacked)
        : change_(change), unpacked_(unpacked) {}

    /// Converts a page. Throws Error if its resources are nested too deeply.
    void convert(QPDFPageObjectHelper page);

    /// Returns the kinds of content that were not converted, for example "shadings".
    const std::set<std::string>& unconverted() const { return unconverted_; }

  private:
    QPDFObjectHandle resources(QPDFObjectHandle original);
    QPDFObjectHandle content(QPDFObjectHandle original, bool starts_black);
    QPDFObjectHandle xobject(QPDFObjectHandle original);
    QPDFObjectHandle pattern(QPDFObjectHandle original);
    QPDFObjectHandle font(QPDFObjectHandle original);
    QPDFObjectHandle image(QPDFObjectHandle original, QPDFObjectHandle spaces);
    QPDFObjectHandle appearance(QPDFObjectHandle original);
    template <typename Convert>
    void replace_all(QPDFObjectHandle resources, const char* kind, Convert convert);

    InkChange change_;
    UnpackedBytes& unpacked_;
    int level_ = 0;  ///< nesting depth of the resources being converted
    std::map<QPDFObjGen, QPDFObjectHandle> converted_;
    std::set<std::string> unconverted_;
};

}  // namespace dotpose::print
