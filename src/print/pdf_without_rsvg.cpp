// Implements ScriptText for builds without librsvg. All functions that typeset text throw Error.
#include "dotpose/files/error.hpp"
#include "pdf_script_text.hpp"

namespace dotpose::print {
namespace {

[[noreturn]] void fail(const std::string& text) {
    throw Error("the label '" + text +
                "' cannot be set: dotpose was built without librsvg; use Latin letters");
}

}  // namespace

bool ScriptText::is_available() {
    return false;
}

double ScriptText::width_pt(const std::string& utf8, double) {
    fail(utf8);
}

std::string ScriptText::draw(const std::string& utf8, double, double, double) {
    fail(utf8);
}

void ScriptText::add_to(QPDFObjectHandle) {}

}  // namespace dotpose::print
