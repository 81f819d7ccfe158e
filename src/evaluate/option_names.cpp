#include "dotpose/tools/option_names.hpp"

namespace dotpose {

const char* name(Decoder decoder) {
    return decoder == Decoder::window ? "window" : "all";
}

const char* name(Effort effort) {
    switch (effort) {
        case Effort::device:
            return "device";
        case Effort::once:
            return "once";
        case Effort::twice:
            break;
    }
    return "twice";
}

}  // namespace dotpose
