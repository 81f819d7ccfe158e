#include "dotpose/files/code_names.hpp"

namespace dotpose {

const char* name(CodeVariant code) {
    switch (code) {
        case CodeVariant::anoto:
            return "anoto";
        case CodeVariant::libdots:
            return "libdots";
        case CodeVariant::microdots:
            return "microdots";
    }
    return "";
}

std::optional<CodeVariant> code_by_name(std::string_view asked) {
    for (const CodeVariant code :
         {CodeVariant::anoto, CodeVariant::libdots, CodeVariant::microdots}) {
        if (asked == name(code)) return code;
    }
    return std::nullopt;
}

}  // namespace dotpose
