/// Checks the files of one run: no output may be one of its inputs, and two outputs must not be the
/// same file. Every command registers its files here before it opens any.
///
///     RunFiles files;
///     files.reads("--sheets", arguments.sheets);
///     files.writes("-o", arguments.out, Content::json);
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "fields.hpp"
#include "output_arguments.hpp"

namespace dotpose::cli {

/// The kind of data in an output file; `own` means that the ending of its name chooses the format.
enum class Content { json, csv, yaml, svg, packets, mcap, text, own };

Content content_of(RecordFormat format);
Content content_of(const ReportArguments& report);

/// Identity of a file: names with equal identities refer to one file, whatever links and folders
/// they contain. Names of new files that differ only in upper and lower case have equal identities.
struct FileIdentity {
    dev_t device = 0;
    ino_t inode = 0;       ///< inode of the file, or of the folder if the file does not exist yet
    std::string new_name;  ///< in lower case; empty if the file exists
    auto operator<=>(const FileIdentity&) const = default;
};

/// Returns the identity of a file, or none for devices, pipes and names in folders that do not
/// exist.
std::optional<FileIdentity> identity_of(const std::string& path);

/// An empty name means that there is no file. The functions throw BadArgument that names both
/// options if they refuse a file.
class RunFiles {
  public:
    /// Registers an input. `option` is its flag, or empty for an argument without a flag; "-" is
    /// standard input.
    void reads(const std::string& option, const std::string& path);
    void reads(const std::string& option, const std::vector<std::string>& paths);

    /// Registers an output. It is refused if the ending of its name is that of an image or video
    /// of another kind than `content`: with `-o frames/*.png`, where the name of the output is
    /// missing, the first frame would be overwritten. "-" is standard output for `-o`, and refused
    /// for other options.
    void writes(const std::string& option, const std::string& path, Content content);

    /// Registers the output of lines to the file of `-o`, or to standard output without it.
    void writes_lines(const std::string& path, Content content);

    /// Registers a file that is read, changed and written, or created if it does not exist.
    void updates(const std::string& option, const std::string& path, Content content);

    /// Checks an input like `reads` without keeping its name, for runs with any number of inputs.
    void require_not_written(const std::string& path) const;

    /// Checks an output like `writes` without keeping its name, for generated names, which differ
    /// from each other.
    void require_free(const std::string& option, const std::string& path) const;

  private:
    void add_output(const std::string& label, const std::string& path);
    void require_free(const std::string& label, const FileIdentity& identity) const;

    std::map<FileIdentity, std::string> inputs_;  ///< with the names that the user gave them
    std::map<FileIdentity, std::string> outputs_;
};

}  // namespace dotpose::cli
