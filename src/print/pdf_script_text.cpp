#include "pdf_script_text.hpp"

#include <memory>
#include <string_view>

#include <cairo-pdf.h>
#include <fmt/core.h>
#include <librsvg/rsvg.h>
#include <qpdf/Buffer.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>

#include "dotpose/files/error.hpp"

namespace dotpose::print {
namespace {

/// Space above and below the baseline, relative to the font size. The space is sufficient for
/// stacked diacritics.
constexpr double kAscent = 1.5;
constexpr double kDescent = 0.8;

template <auto Free>
struct Freed {
    template <typename Object>
    void operator()(Object* object) const {
        Free(object);
    }
};
using Drawing = std::unique_ptr<RsvgHandle, Freed<g_object_unref>>;
using Surface = std::unique_ptr<cairo_surface_t, Freed<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Freed<cairo_destroy>>;

std::string escaped(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '&') {
            escaped += "&amp;";
        } else if (c == '<') {
            escaped += "&lt;";
        } else {
            escaped += c;
        }
    }
    return escaped;
}

[[noreturn]] void fail(const std::string& text) {
    throw Error(fmt::format("the label '{}' cannot be set", text));
}

/// Returns a drawing of the text. The unit of the drawing is a point. librsvg selects the fonts,
/// and joins and orders the letters according to the rules of their script.
Drawing drawing_of(const std::string& text, double size_pt, double width_pt) {
    const std::string svg = fmt::format(
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}">)"
        R"(<text id="t" x="0" y="{2}" font-family="Helvetica, sans-serif" font-size="{3}" )"
        R"(xml:space="preserve">{4}</text></svg>)",
        width_pt, (kAscent + kDescent) * size_pt, kAscent * size_pt, size_pt, escaped(text));
    const auto* bytes = reinterpret_cast<const guint8*>(svg.data());
    Drawing drawing(rsvg_handle_new_from_data(bytes, svg.size(), nullptr));
    if (!drawing) fail(text);
    return drawing;
}

cairo_status_t append(void* document, const unsigned char* data, unsigned size) {
    static_cast<std::string*>(document)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
}

std::string document_of(const std::string& text, double size_pt, double width_pt) {
    const RsvgRectangle page{0, 0, width_pt, (kAscent + kDescent) * size_pt};
    const Drawing drawing = drawing_of(text, size_pt, width_pt);
    std::string document;
    const Surface surface(
        cairo_pdf_surface_create_for_stream(append, &document, page.width, page.height));
    const Context context(cairo_create(surface.get()));
    if (rsvg_handle_render_document(drawing.get(), context.get(), &page, nullptr) == 0) fail(text);
    cairo_show_page(context.get());
    cairo_surface_finish(surface.get());
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) fail(text);
    return document;
}

/// Changes the text of a form to pure black ink. cairo writes RGB black, which printers mix from
/// all inks.
void use_black_ink(QPDFObjectHandle form) {
    constexpr std::string_view kOfScreens = "0 0 0 rg";
    constexpr std::string_view kInk = "0 0 0 1 k";
    const auto data = form.getStreamData();
    std::string content(reinterpret_cast<const char*>(data->getBuffer()), data->getSize());
    for (std::size_t at = content.find(kOfScreens); at != std::string::npos;
         at = content.find(kOfScreens, at)) {
        content.replace(at, kOfScreens.size(), kInk);
    }
    form.replaceStreamData(content, QPDFObjectHandle::newNull(), QPDFObjectHandle::newNull());
    form.getDict().removeKey("/Group");
}

}  // namespace

bool ScriptText::is_available() {
    return true;
}

double ScriptText::width_pt(const std::string& utf8, double size_pt) {
    const std::string key = fmt::format("{} {}", size_pt, utf8);
    const auto known = widths_pt_.find(key);
    if (known != widths_pt_.end()) return known->second;
    constexpr double kAny_pt = 1;
    const Drawing drawing = drawing_of(utf8, size_pt, kAny_pt);
    RsvgRectangle ink{};
    if (rsvg_handle_get_geometry_for_element(drawing.get(), "#t", &ink, nullptr, nullptr) == 0) {
        fail(utf8);
    }
    return widths_pt_[key] = ink.x + ink.width;
}

QPDFObjectHandle ScriptText::form_of(const std::string& utf8, double size_pt) {
    const std::string key = fmt::format("{} {}", size_pt, utf8);
    const auto known = forms_.find(key);
    if (known != forms_.end()) return known->second;
    const std::string document = document_of(utf8, size_pt, width_pt(utf8, size_pt) + 1);
    QPDF& source = *sources_.emplace_back(std::make_unique<QPDF>());
    // `document` is destroyed at the end of this function, so streams must be copied immediately.
    source.setImmediateCopyFrom(true);
    source.processMemoryFile("label", document.data(), document.size());
    QPDFPageObjectHelper page = QPDFPageDocumentHelper(source).getAllPages().front();
    QPDFObjectHandle form = page.getFormXObjectForPage();
    use_black_ink(form);
    return forms_[key] = pdf_.copyForeignObject(form);
}

std::string ScriptText::draw(const std::string& utf8, double size_pt, double x_pt, double y_pt) {
    const std::string name = fmt::format("/Text{}", drawn_.size() + 1);
    drawn_[name] = form_of(utf8, size_pt);
    return fmt::format("q 1 0 0 1 {:.3f} {:.3f} cm {} Do Q\n", x_pt, y_pt - kDescent * size_pt,
                       name);
}

void ScriptText::add_to(QPDFObjectHandle resources) {
    if (drawn_.empty()) return;
    QPDFObjectHandle objects = QPDFObjectHandle::newDictionary();
    for (const auto& [name, form] : drawn_)
        objects.replaceKey(name, form);
    resources.replaceKey("/XObject", objects);
    drawn_.clear();
}

}  // namespace dotpose::print
