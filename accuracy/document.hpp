/// The generated parts of a document: what stands between `<!-- begin NAME -->` and
/// `<!-- end NAME -->`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

struct Block {
    std::string name;
    std::string text;
};
using Blocks = std::vector<Block>;

/// Throws dotpose::Error.
std::string read_document(const std::filesystem::path& path);

/// Replaces the blocks. Throws dotpose::Error.
void update_document(const std::filesystem::path& path, const Blocks& blocks);

/// Copies all pictures (SVG) of `folder` to the folder beside the document that has its name.
void update_pictures(const std::filesystem::path& path, const std::filesystem::path& folder);
