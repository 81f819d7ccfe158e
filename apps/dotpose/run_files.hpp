/// Checks the files of a run: no output may also be an input, and no two outputs may be the same
/// file. Every command registers its files before it opens any of them.
///
///     RunFiles files;
///     files.reads("--sheets", arguments.sheets);
///     files.writes("-o", arguments.out, Content::json);
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"
#include "output_arguments.hpp"

namespace dotpose::cli {

/// Kind of data in an output file. `own` means that the file extension determines the kind.
enum class Content { json, csv, yaml, svg, packets, mcap, text, own };

Content content_of(RecordFormat format);
Content content_of(const ReportArguments& report);

/// Identity of a file. All paths to a file have the same identity, even if they contain links or
/// lead through different folders. New files in the same folder whose names differ only in case
/// also have the same identity, because some file systems ignore case.
struct FileIdentity {
    std::uint64_t device = 0;
    std::uint64_t file = 0;  ///< identifies the file, or its folder if the file does not exist
    std::string new_name;    ///< file name in lower case, or empty if the file exists
    auto operator<=>(const FileIdentity&) const = default;
};

/// Returns the identity of a file, or none for a device, a pipe, or a path in a nonexistent folder.
std::optional<FileIdentity> identity_of(const std::string& path);

/// The files of a run. Empty paths are ignored. If a file is rejected, the functions throw
/// BadArgument. The message names the options of the files involved.
class RunFiles {
  public:
    /// Registers an input. `option` is the flag, or empty for a positional argument. The path "-"
    /// means standard input.
    void reads(const std::string& option, const std::string& path);
    void reads(const std::string& option, const std::vector<std::string>& paths);

    /// Registers an output. Rejects a path with the file extension of an image or video, unless the
    /// extension matches `content`. This check prevents a common mistake: if the output name is
    /// missing, as in `-o frames/*.png`, the shell expands the glob, and -o would overwrite the
    /// first frame. The path "-" means standard output for `-o` and is rejected for other options.
    void writes(const std::string& option, const std::string& path, Content content);

    /// Registers the destination of the output lines: the file given to -o, or standard output if
    /// -o is not given.
    void writes_lines(const std::string& path, Content content);

    /// Registers a file that is read, changed and rewritten, or created if it does not exist.
    void updates(const std::string& option, const std::string& path, Content content);

    /// Checks an input in the same way as `reads`, but does not store the path, because the number
    /// of inputs is not limited.
    void require_not_written(const std::string& path) const;

    /// Checks an output in the same way as `writes`, but does not store the path. Use this function
    /// for generated names, which are known to differ from each other.
    void require_free(const std::string& option, const std::string& path) const;

  private:
    void add_input(const std::string& label, const std::optional<FileIdentity>& identity);
    void add_output(const std::string& label, const std::optional<FileIdentity>& identity);
    void require_free(const std::string& label, const FileIdentity& identity) const;

    /// Option and path of each input, for error messages.
    std::map<FileIdentity, std::string> inputs_;
    std::map<FileIdentity, std::string> outputs_;
};

}  // namespace dotpose::cli
