/// Rewrites the colour operators in one content stream.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <qpdf/QPDFObjectHandle.hh>

#include "pdf_ink.hpp"

namespace dotpose::print {

class ColourFilter : public QPDFObjectHandle::TokenFilter {
  public:
    /// `spaces` contains the kind of each colour space that the operators `cs` and `CS` can select
    /// by name. `starts_black` must be true for pages, where the initial colours are black. In this
    /// case, the filter first writes operators that set the fill and stroke colours to the
    /// converted black. If `starts_black` is false, the initial colours are inherited.
    ColourFilter(InkChange change, std::map<std::string, ColourKind> spaces, bool starts_black);

    void handleToken(QPDFTokenizer::Token const& token) override;
    void handleEOF() override;

  private:
    struct Kinds {
        ColourKind fill = ColourKind::other;
        ColourKind stroke = ColourKind::other;
    };

    /// Writes an operator and its operands in converted form. If no conversion is needed, returns
    /// false and writes nothing.
    bool rewrite(const std::string& name);
    bool select_space(ColourKind& kind, bool is_stroke);
    bool write_colour(ColourKind from, std::vector<double> colour, bool is_stroke);
    bool numbers(std::vector<double>& values) const;
    void flush();

    InkChange change_;
    std::map<std::string, ColourKind> spaces_;
    bool starts_black_;
    Kinds now_;
    std::vector<Kinds> saved_;
    std::vector<QPDFTokenizer::Token> pending_;
};

}  // namespace dotpose::print
