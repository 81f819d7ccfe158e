#include "pdf_colours.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/core.h>

#include "pdf_colour_filter.hpp"

namespace dotpose::print {
namespace {

QPDFObjectHandle colour_spaces(QPDFObjectHandle resources) {
    return resources.isDictionary() ? resources.getKey("/ColorSpace") : QPDFObjectHandle::newNull();
}

std::map<std::string, ColourKind> named_spaces(QPDFObjectHandle resources) {
    std::map<std::string, ColourKind> kinds;
    QPDFObjectHandle spaces = colour_spaces(resources);
    if (!spaces.isDictionary()) return kinds;
    for (const auto& [name, space] : spaces.ditems())
        kinds[name] = kind_of_space(space, QPDFObjectHandle::newNull());
    return kinds;
}

/// If black is converted to cyan, magenta and yellow, sets the blending colour space of `holder`'s
/// transparency group to CMYK. Blending in RGB would convert the mix of the three inks back to
/// black.
void blend_in_cmyk(QPDFObjectHandle holder, InkChange change) {
    QPDFObjectHandle group = holder.getKey("/Group");
    if (!change.black_to_cmy || !group.isDictionary() || !group.hasKey("/CS")) return;
    QPDFObjectHandle copy = group.shallowCopy();
    copy.replaceKey("/CS", QPDFObjectHandle::newName("/DeviceCMYK"));
    holder.replaceKey("/Group", copy);
}

std::string palette_bytes(QPDFObjectHandle table, UnpackedBytes& unpacked) {
    if (table.isString()) return table.getStringValue();
    if (!table.isStream()) return {};
    unpacked.count(table);
    const auto data = table.getStreamData();
    return {reinterpret_cast<const char*>(data->getBuffer()), data->getSize()};
}

/// Returns an indexed colour space, [/Indexed space last table], with `count` converted colours.
/// `bytes` contains the components of the original colours.
QPDFObjectHandle indexed(InkChange change, ColourKind from, const std::string& bytes,
                         std::size_t count) {
    const std::size_t size = components(from);
    std::string table;
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<double> colour(size, 0.0);
        for (std::size_t k = 0; k < size && i * size + k < bytes.size(); ++k)
            colour[k] = static_cast<unsigned char>(bytes[i * size + k]) / 255.0;
        for (const double value : change.apply(from, colour))
            table += static_cast<char>(static_cast<unsigned char>(value * 255 + 0.5));
    }
    const ColourKind kind = change.kind(from);
    const char* base = kind == ColourKind::grey  ? "/DeviceGray"
                       : kind == ColourKind::rgb ? "/DeviceRGB"
                                                 : "/DeviceCMYK";
    QPDFObjectHandle space = QPDFObjectHandle::newArray();
    space.appendItem(QPDFObjectHandle::newName("/Indexed"));
    space.appendItem(QPDFObjectHandle::newName(base));
    space.appendItem(QPDFObjectHandle::newInteger(static_cast<long long>(count) - 1));
    space.appendItem(QPDFObjectHandle::newString(table));
    return space;
}

bool convert_palette(InkChange change, QPDFObjectHandle dict, QPDFObjectHandle space,
                     QPDFObjectHandle spaces, UnpackedBytes& unpacked) {
    if (!space.isArray() || space.getArrayNItems() != 4 ||
        !space.getArrayItem(0).isNameAndEquals("/Indexed") || !space.getArrayItem(2).isInteger()) {
        return false;
    }
    const ColourKind kind = kind_of_space(space.getArrayItem(1), spaces);
    const long long last = space.getArrayItem(2).getIntValue();
    if (kind == ColourKind::other || last < 0 || last > 255) return false;
    dict.replaceKey("/ColorSpace",
                    indexed(change, kind, palette_bytes(space.getArrayItem(3), unpacked),
                            static_cast<std::size_t>(last) + 1));
    return true;
}

/// Replaces the grey colour space of an image with a palette of converted colours, so the pixel
/// data need not be changed or decompressed. If the number of bits per pixel is missing or not in
/// the range 1 to 8, returns false and changes nothing.
bool convert_grey(InkChange change, QPDFObjectHandle dict, ColourKind kind) {
    QPDFObjectHandle depth = dict.getKey("/BitsPerComponent");
    if (!depth.isInteger() || depth.getIntValue() > 8 || depth.getIntValue() < 1) return false;
    const int last = (1 << depth.getIntValueAsInt()) - 1;
    std::string levels;
    for (int level = 0; level <= last; ++level)
        levels += static_cast<char>(static_cast<unsigned char>(level * 255 / last));
    dict.replaceKey("/ColorSpace", indexed(change, kind, levels, levels.size()));
    QPDFObjectHandle decode = dict.getKey("/Decode");
    if (decode.isArray() && decode.getArrayNItems() == 2 && decode.getArrayItem(0).isNumber()) {
        const bool is_inverted = decode.getArrayItem(0).getNumericValue() > 0.5;
        dict.replaceKey("/Decode",
                        QPDFObjectHandle::parse(is_inverted ? fmt::format("[{} 0]", last)
                                                            : fmt::format("[0 {}]", last)));
    }
    return true;
}

/// Returns a colour space with three components: the amounts of cyan, magenta and yellow.
QPDFObjectHandle cmy_space(QPDF* pdf) {
    QPDFObjectHandle add_no_black = QPDFObjectHandle::newStream(pdf, "{ 0 }");
    add_no_black.replaceDict(QPDFObjectHandle::parse(
        "<< /FunctionType 4 /Domain [0 1 0 1 0 1] /Range [0 1 0 1 0 1 0 1] >>"));
    QPDFObjectHandle space =
        QPDFObjectHandle::parse("[/DeviceN [/Cyan /Magenta /Yellow] /DeviceCMYK]");
    space.appendItem(add_no_black);
    return space;
}

/// Converts the colours of an image by changing its /Decode array and, if necessary, its colour
/// space. /Decode maps samples to colour values. The pixel data do not change. Returns false and
/// changes nothing if the image is in CMYK and its black is to be converted, because /Decode cannot
/// express this conversion.
bool convert_decode(InkChange change, QPDFObjectHandle dict, ColourKind kind, QPDF* pdf) {
    if (kind == ColourKind::cmyk && change.black_to_cmy) return false;
    const std::size_t count = 2 * components(kind);
    QPDFObjectHandle decode = dict.getKey("/Decode");
    const bool has_decode = decode.isArray() && decode.getArrayNItems() == static_cast<int>(count);
    const double keep = 1 - change.lighten;
    std::string changed = "[";
    for (std::size_t i = 0; i < count; ++i) {
        double value = i % 2 == 0 ? 0 : 1;
        if (has_decode) value = decode.getArrayItem(static_cast<int>(i)).getNumericValue();
        const double ink = (kind == ColourKind::cmyk ? value : 1 - value) * keep;
        const bool as_ink = kind == ColourKind::cmyk || change.black_to_cmy;
        changed += fmt::format("{:.6g} ", as_ink ? ink : 1 - ink);
    }
    if (change.black_to_cmy) {
        dict.replaceKey("/ColorSpace", cmy_space(pdf));
    }
    dict.replaceKey("/Decode", QPDFObjectHandle::parse(changed + "]"));
    return true;
}

}  // namespace

void ColourConverter::convert(QPDFPageObjectHelper page) {
    unpacked_.start_page();
    constexpr bool kInFormsOfForms = true;
    page.forEachFormXObject(kInFormsOfForms,
                            [this](QPDFObjectHandle& form, QPDFObjectHandle& /*forms*/,
                                   const std::string& /*name*/) { unpacked_.count(form); });
    page.externalizeInlineImages();
    QPDFObjectHandle dict = page.getObjectHandle();
    QPDFObjectHandle original = page.getAttribute("/Resources", false);
    QPDFObjectHandle contents = dict.getKey("/Contents");
    // Other pages may share the stream, so this page gets a copy.
    if (contents.isStream()) dict.replaceKey("/Contents", contents.copyStream());
    if (!page.getPageContents().empty()) {
        page.addContentTokenFilter(
            std::make_shared<ColourFilter>(change_, named_spaces(original), true));
    }
    blend_in_cmyk(dict, change_);
    dict.replaceKey("/Resources", resources(original));
    for (QPDFAnnotationObjectHelper& annotation : page.getAnnotations()) {
        QPDFObjectHandle appearances = annotation.getAppearanceDictionary();
        if (!appearances.isDictionary()) continue;
        QPDFObjectHandle copy = appearances.shallowCopy();
        for (const std::string& state : copy.getKeys())
            copy.replaceKey(state, appearance(copy.getKey(state)));
        annotation.getObjectHandle().replaceKey("/AP", copy);
    }
}

QPDFObjectHandle ColourConverter::appearance(QPDFObjectHandle original) {
    if (!original.isDictionary()) return content(original, true);
    // An appearance may have one stream per state, such as /On and /Off. Deeper dictionaries are
    // ignored, so cyclic references are harmless.
    QPDFObjectHandle copy = original.shallowCopy();
    for (const std::string& state : copy.getKeys())
        copy.replaceKey(state, content(copy.getKey(state), true));
    return copy;
}

template <typename Convert>
void ColourConverter::replace_all(QPDFObjectHandle resources, const char* kind, Convert convert) {
    QPDFObjectHandle originals = resources.getKey(kind);
    if (!originals.isDictionary()) return;
    QPDFObjectHandle copies = originals.shallowCopy();
    for (const std::string& name : copies.getKeys())
        copies.replaceKey(name, convert(copies.getKey(name)));
    resources.replaceKey(kind, copies);
}

QPDFObjectHandle ColourConverter::resources(QPDFObjectHandle original) {
    if (!original.isDictionary()) return QPDFObjectHandle::newDictionary();
    const QPDFObjGen id = original.getObjGen();
    if (original.isIndirect() && converted_.contains(id)) return converted_.at(id);
    require_pdf_level("resources", ++level_);
    QPDFObjectHandle copy = original.shallowCopy();
    if (original.isIndirect()) {
        copy = original.getOwningQPDF()->makeIndirectObject(copy);
        converted_[id] = copy;
    }
    QPDFObjectHandle spaces = colour_spaces(original);
    replace_all(copy, "/XObject", [&](QPDFObjectHandle object) {
        const bool is_image =
            object.isStream() && object.getDict().getKey("/Subtype").isNameAndEquals("/Image");
        return is_image ? image(object, spaces) : xobject(object);
    });
    replace_all(copy, "/Pattern", [&](QPDFObjectHandle object) { return pattern(object); });
    replace_all(copy, "/Font", [&](QPDFObjectHandle object) { return font(object); });
    if (original.getKey("/Shading").isDictionary()) unconverted_.insert("shadings");
    for (const auto& [name, kind] : named_spaces(original)) {
        if (kind == ColourKind::other) unconverted_.insert("colours of special colour spaces");
    }
    --level_;
    return copy;
}

QPDFObjectHandle ColourConverter::xobject(QPDFObjectHandle original) {
    const bool is_form =
        original.isStream() && original.getDict().getKey("/Subtype").isNameAndEquals("/Form");
    return is_form ? content(original, false) : original;
}

QPDFObjectHandle ColourConverter::content(QPDFObjectHandle original, bool starts_black) {
    if (!original.isStream()) return original;
    const QPDFObjGen id = original.getObjGen();
    if (converted_.contains(id)) return converted_.at(id);
    unpacked_.count(original);
    QPDFObjectHandle copy = original.copyStream();
    converted_[id] = copy;
    QPDFObjectHandle used = original.getDict().getKey("/Resources");
    copy.addTokenFilter(std::make_shared<ColourFilter>(change_, named_spaces(used), starts_black));
    if (used.isDictionary()) copy.getDict().replaceKey("/Resources", resources(used));
    blend_in_cmyk(copy.getDict(), change_);
    return copy;
}

QPDFObjectHandle ColourConverter::pattern(QPDFObjectHandle original) {
    if (!original.isStream()) {
        unconverted_.insert("shadings");
        return original;
    }
    // An uncoloured tiling pattern is painted in the current colour, which is already converted, so
    // the pattern itself is not converted.
    const bool is_coloured = original.getDict().getKey("/PaintType").isInteger() &&
                             original.getDict().getKey("/PaintType").getIntValue() == 1;
    if (!is_coloured) unconverted_.insert("uncoloured patterns");
    return is_coloured ? content(original, true) : original;
}

QPDFObjectHandle ColourConverter::font(QPDFObjectHandle original) {
    if (!original.isDictionary() || !original.getKey("/Subtype").isNameAndEquals("/Type3")) {
        return original;
    }
    const QPDFObjGen id = original.getObjGen();
    if (original.isIndirect() && converted_.contains(id)) return converted_.at(id);
    QPDFObjectHandle copy = original.shallowCopy();
    if (original.isIndirect()) {
        copy = original.getOwningQPDF()->makeIndirectObject(copy);
        converted_[id] = copy;
    }
    replace_all(copy, "/CharProcs", [&](QPDFObjectHandle glyph) { return content(glyph, false); });
    if (copy.hasKey("/Resources")) {
        copy.replaceKey("/Resources", resources(original.getKey("/Resources")));
    }
    return copy;
}

QPDFObjectHandle ColourConverter::image(QPDFObjectHandle original, QPDFObjectHandle spaces) {
    const QPDFObjGen id = original.getObjGen();
    if (converted_.contains(id)) return converted_.at(id);
    QPDFObjectHandle mask = original.getDict().getKey("/ImageMask");
    if (mask.isBool() && mask.getBoolValue()) return original;  // a stencil mask has no colours
    QPDFObjectHandle copy = original.copyStream();
    QPDFObjectHandle dict = copy.getDict();
    QPDFObjectHandle space = dict.getKey("/ColorSpace");
    if (space.isName() && spaces.isDictionary() && spaces.hasKey(space.getName())) {
        space = spaces.getKey(space.getName());
    }
    const ColourKind kind = kind_of_space(space, spaces);
    const bool is_single = kind == ColourKind::grey || kind == ColourKind::black;
    const bool done = kind == ColourKind::other
                          ? convert_palette(change_, dict, space, spaces, unpacked_)
                      : is_single ? convert_grey(change_, dict, kind)
                                  : convert_decode(change_, dict, kind, original.getOwningQPDF());
    if (!done) unconverted_.insert(kind == ColourKind::cmyk ? "CMYK images" : "some images");
    converted_[id] = done ? copy : original;
    return converted_.at(id);
}

}  // namespace dotpose::print
