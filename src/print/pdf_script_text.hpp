/// Typesets labels in any script for a PDF page. Helvetica, which is not embedded, has only Latin
/// letters, so other letters are drawn with fonts installed on the computer.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <qpdf/QPDF.hh>
#include <qpdf/QPDFObjectHandle.hh>

namespace dotpose::print {

/// Lines of text as form XObjects with embedded fonts. Identical lines on several pages share one
/// object.
class ScriptText {
  public:
    /// `pdf` must outlive this object, and this object must not be destroyed before `pdf` has been
    /// written.
    explicit ScriptText(QPDF& pdf) : pdf_(pdf) {}

    /// Returns false if dotpose was built without librsvg, which typesets the lines.
    static bool is_available();

    /// Returns the width of a line in points. Throws Error if the line cannot be typeset.
    double width_pt(const std::string& utf8, double size_pt);

    /// Returns the content that draws a line with its baseline at (x_pt, y_pt). Throws Error if the
    /// line cannot be typeset.
    std::string draw(const std::string& utf8, double size_pt, double x_pt, double y_pt);

    /// Adds all lines drawn since the last call to the resources of a page.
    void add_to(QPDFObjectHandle resources);

  private:
    QPDFObjectHandle form_of(const std::string& utf8, double size_pt);

    QPDF& pdf_;
    std::map<std::string, double> widths_pt_;
    /// Form of each line, by font size and text.
    std::map<std::string, QPDFObjectHandle> forms_;
    /// Lines drawn on the current page, by name.
    std::map<std::string, QPDFObjectHandle> drawn_;
    std::vector<std::unique_ptr<QPDF>> sources_;  ///< documents that contain the original forms
};

}  // namespace dotpose::print
