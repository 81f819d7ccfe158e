#include "files/sheet_json.hpp"

#include <cstdint>
#include <limits>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "dotpose/files/code_names.hpp"
#include "files/input_file.hpp"
#include "files/sheet_list.hpp"

namespace dotpose::files {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "dotpose-sheets";

/// A JSON object in the file, and its location in the JSON tree for error messages.
class Node {
  public:
    Node(const json& value, std::string file, std::string path)
        : value_(value), file_(std::move(file)), path_(std::move(path)) {
        if (!value_.is_object()) fail(path_, "must be an object");
    }

    Node object(const char* key) const { return {member(key), file_, path_of(key)}; }

    std::vector<Node> objects(const char* key) const {
        const json& array = member(key);
        if (!array.is_array()) fail(path_of(key), "must be an array");
        std::vector<Node> nodes;
        for (std::size_t i = 0; i < array.size(); ++i)
            nodes.emplace_back(array[i], file_, fmt::format("{}[{}]", path_of(key), i));
        return nodes;
    }

    std::string text(const char* key) const {
        const json& value = member(key);
        if (!value.is_string()) fail(path_of(key), "must be a string");
        return value.get<std::string>();
    }

    double number(const char* key) const {
        const json& value = member(key);
        if (!value.is_number()) fail(path_of(key), "must be a number");
        return value.get<double>();
    }

    std::int64_t whole(const char* key, std::int64_t min, std::int64_t max) const {
        const json& value = member(key);
        if (!value.is_number_integer()) fail(path_of(key), "must be a whole number");
        // nlohmann-json stores numbers of 2^63 and above as unsigned integers. Conversion to a
        // signed integer would overflow.
        const bool is_huge =
            value.is_number_unsigned() &&
            value.get<std::uint64_t>() > std::uint64_t{std::numeric_limits<std::int64_t>::max()};
        const auto number = value.get<std::int64_t>();
        if (is_huge || number < min || number > max) {
            fail(path_of(key), fmt::format("is {}; it must be {} to {}", value.dump(), min, max));
        }
        return number;
    }

    bool flag(const char* key) const {
        const json& value = member(key);
        if (!value.is_boolean()) fail(path_of(key), "must be true or false");
        return value.get<bool>();
    }

    bool has(const char* key) const { return value_.contains(key); }

    [[noreturn]] void fail_at(const char* key, const std::string& problem) const {
        fail(path_of(key), problem);
    }
    [[noreturn]] void fail_here(const std::string& problem) const { fail(path_, problem); }

  private:
    [[noreturn]] void fail(const std::string& path, const std::string& problem) const {
        const char* const separator = path.empty() ? "" : " ";
        throw Error(fmt::format("{}: {}{}{}", file_, path, separator, problem));
    }
    std::string path_of(const char* key) const {
        return path_.empty() ? key : fmt::format("{}.{}", path_, key);
    }
    const json& member(const char* key) const {
        const auto found = value_.find(key);
        if (found == value_.end()) fail(path_of(key), "is missing");
        return *found;
    }

    const json& value_;
    std::string file_;
    std::string path_;
};

json parse(const std::string& text, const std::string& file) {
    try {
        return parse_json(text);
    } catch (const Error& error) {
        throw Error(fmt::format("{} is not a sheet file: {}", file, error.what()));
    }
}

Sheet sheet_of(const Node& node) {
    constexpr std::int64_t kLastCell = kPositionsPerAxis - 1;
    const auto section = [&node](const char* key) {
        return static_cast<std::uint8_t>(node.whole(key, 0, kSections - 1));
    };
    const auto cell = [&node](const char* key) {
        return static_cast<std::uint32_t>(node.whole(key, 0, kLastCell));
    };
    const auto count = [&node](const char* key) {
        return static_cast<int>(node.whole(key, kMinSheetCells, kPositionsPerAxis));
    };
    Sheet sheet;
    const std::string name = node.text("code");
    const auto code = code_by_name(name);
    if (!code) {
        node.fail_at("code", fmt::format("is '{}'; it must be anoto, libdots or microdots", name));
    }
    sheet.pattern.code = *code;
    sheet.pattern.section = {section("section_u"), section("section_v")};
    sheet.pattern.spacing_mm = node.number("spacing_mm");
    sheet.pattern.displacement_mm = node.number("displacement_mm");
    sheet.pattern.dot_mm = node.number("dot_mm");
    sheet.origin = {cell("origin_x"), cell("origin_y")};
    sheet.columns = count("columns");
    sheet.rows = count("rows");
    sheet.width_mm = node.number("width_mm");
    sheet.height_mm = node.number("height_mm");
    sheet.origin_x_mm = node.number("first_x_mm");
    sheet.origin_y_mm = node.number("first_y_mm");
    return sheet;
}

SheetPrint print_of(const Node& node) {
    SheetPrint print;
    print.title = node.text("title");
    print.pages = static_cast<int>(node.whole("pages", 1, std::numeric_limits<int>::max()));
    print.dpi = node.number("dpi");
    print.dots = node.text("dots");
    print.has_labels = node.flag("labels");
    print.command = node.text("command");
    if (node.has("document")) print.document = node.text("document");
    return print;
}

SheetEntry entry_of(const Node& node) {
    SheetEntry entry;
    entry.name = node.text("name");
    entry.page = static_cast<int>(node.whole("page", 1, std::numeric_limits<int>::max()));
    entry.sheet = sheet_of(node);
    if (node.has("print_scale_x")) entry.print_scale_x = node.number("print_scale_x");
    if (node.has("print_scale_y")) entry.print_scale_y = node.number("print_scale_y");
    if (node.has("reserved")) entry.is_reserved = node.flag("reserved");
    if (node.has("world")) {
        const Node world = node.object("world");
        entry.world = {world.number("x_m"), world.number("y_m"), world.number("yaw_rad")};
    }
    if (node.has("print")) entry.print = print_of(node.object("print"));
    return entry;
}

void update(json& object, const SheetPrint& print) {
    object["title"] = print.title;
    object["pages"] = print.pages;
    object["dpi"] = print.dpi;
    object["dots"] = print.dots;
    object["labels"] = print.has_labels;
    object["command"] = print.command;
    if (print.document.empty()) {
        object.erase("document");
    } else {
        object["document"] = print.document;
    }
}

void update(json& object, const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    const Pattern& pattern = sheet.pattern;
    object["name"] = entry.name;
    object["page"] = entry.page;
    object["code"] = name(pattern.code);
    object["section_u"] = pattern.section.u;
    object["section_v"] = pattern.section.v;
    object["spacing_mm"] = pattern.spacing_mm;
    object["displacement_mm"] = pattern.displacement_mm;
    object["dot_mm"] = pattern.dot_mm;
    object["origin_x"] = sheet.origin.x;
    object["origin_y"] = sheet.origin.y;
    object["columns"] = sheet.columns;
    object["rows"] = sheet.rows;
    object["width_mm"] = sheet.width_mm;
    object["height_mm"] = sheet.height_mm;
    object["first_x_mm"] = sheet.origin_x_mm;
    object["first_y_mm"] = sheet.origin_y_mm;
    object["print_scale_x"] = entry.print_scale_x;
    object["print_scale_y"] = entry.print_scale_y;
    if (entry.is_reserved) {
        object["reserved"] = true;
    } else {
        object.erase("reserved");
    }
    if (entry.world) {
        json& world = object["world"];
        world["x_m"] = entry.world->x_m;
        world["y_m"] = entry.world->y_m;
        world["yaw_rad"] = entry.world->yaw_rad;
    } else {
        object.erase("world");
    }
    if (entry.print) {
        update(object["print"], *entry.print);
    } else {
        object.erase("print");
    }
}

}  // namespace

std::vector<SheetEntry> sheets_from_json(const std::string& text, const std::string& file) {
    const json document = parse(text, file);
    if (!document.is_object() || document.value("format", json()) != kFormat) {
        throw Error(
            fmt::format("{} is not a sheet file: it must be an object whose \"format\" is \"{}\"",
                        file, kFormat));
    }
    const Node root(document, file, "");
    const std::int64_t version = root.whole("version", 1, std::numeric_limits<std::int64_t>::max());
    if (version != kSheetFileVersion) {
        root.fail_at("version", fmt::format("is {}; this dotpose reads version {}", version,
                                            kSheetFileVersion));
    }
    std::vector<SheetEntry> sheets;
    for (const Node& node : root.objects("sheets")) {
        const SheetEntry entry = entry_of(node);
        try {
            append(entry, sheets);
        } catch (const BadArgument& error) {
            node.fail_here(fmt::format("({}): {}", entry.name, error.what()));
        }
    }
    return sheets;
}

std::string json_from_sheets(const std::vector<SheetEntry>& sheets,
                             const std::optional<std::string>& old_text,
                             const std::map<std::string, std::string>& old_names) {
    json document = old_text ? parse_json(*old_text) : json::object();
    document["format"] = kFormat;
    document["version"] = kSheetFileVersion;
    std::map<std::string, json> objects;
    for (const json& object : document.value("sheets", json::array()))
        objects[object.at("name")] = object;
    std::map<std::string, json> renamed;
    for (const auto& [name, old_name] : old_names)
        renamed[name] = objects[old_name];
    for (const auto& [name, old_name] : old_names)
        objects.erase(old_name);
    for (const auto& [name, object] : renamed)
        objects[name] = object;
    json array = json::array();
    for (const SheetEntry& entry : sheets) {
        json& object = objects[entry.name];
        update(object, entry);
        array.push_back(object);
    }
    document["sheets"] = std::move(array);
    // Replaces bytes that are not valid UTF-8. A command line may contain such bytes, for example
    // in file names.
    return document.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace dotpose::files
