/// JSON text for the web pages of dotpose-live.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace dotpose::cli {

/// Returns the value as one line of text. Bytes that are not valid UTF-8, for example in names, are
/// replaced.
inline std::string text_of(const nlohmann::json& value) {
    return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace dotpose::cli
