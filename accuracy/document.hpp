/// Replaces the generated blocks in a document. A block is the text between `<!-- begin NAME -->`
/// and `<!-- end NAME -->`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dotpose {

struct Block {
    std::string name;
    std::string text;
};
using Blocks = std::vector<Block>;

/// Returns the text of a document. Throws Error if it cannot be read.
std::string read_document(const std::filesystem::path& path);

/// Replaces the blocks in a document. Throws Error if a block is not in the document, or if the
/// document cannot be written.
void update_document(const std::filesystem::path& path, const Blocks& blocks);

/// Writes the blocks to tables.md in `folder`. If `document` is not empty, also replaces the blocks
/// in the document and copies all SVG pictures from `folder` to the document's picture folder. The
/// picture folder is next to the document and has the same name without the extension.
void write_tables(const std::filesystem::path& folder, const Blocks& blocks,
                  const std::filesystem::path& document);

}  // namespace dotpose
