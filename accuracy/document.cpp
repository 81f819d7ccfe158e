#include "document.hpp"

#include <fstream>
#include <iterator>

#include <fmt/core.h>

#include <dotpose/files/error.hpp>

namespace dotpose {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
    std::ofstream stream(path, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw Error("cannot write " + path.string());
}

}  // namespace

std::string read_document(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (!stream || text.empty()) throw Error("cannot read " + path.string());
    return text;
}

void update_document(const fs::path& path, const Blocks& blocks) {
    std::string text = read_document(path);
    for (const Block& block : blocks) {
        const std::string begin = fmt::format("<!-- begin {} -->\n", block.name);
        const std::size_t from = text.find(begin);
        const std::size_t to = text.find(fmt::format("<!-- end {} -->", block.name));
        if (from == std::string::npos || to == std::string::npos || to < from) {
            throw Error(fmt::format("{} has no part '{}'", path.string(), block.name));
        }
        const std::size_t start = from + begin.size();
        text.replace(start, to - start, block.text);
    }
    write_text(path, text);
}

void write_tables(const fs::path& folder, const Blocks& blocks, const fs::path& document) {
    std::string tables;
    for (const Block& block : blocks)
        tables += block.text + '\n';
    write_text(folder / "tables.md", tables);
    if (document.empty()) return;
    update_document(document, blocks);
    const fs::path pictures = document.parent_path() / document.stem();
    fs::create_directories(pictures);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() != ".svg") continue;
        fs::copy_file(entry.path(), pictures / entry.path().filename(),
                      fs::copy_options::overwrite_existing);
    }
}

}  // namespace dotpose
