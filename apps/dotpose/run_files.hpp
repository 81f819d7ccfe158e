/// Checks the files of one run: no output may be one of the inputs, and no two outputs may be the
/// same file. Every command registers its files before it opens any of them.
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

/// Kind of data in an output file. With `own`, the file extension determines the kind.
enum class Content { json, csv, yaml, svg, packets, mcap, text, own };

Content content_of(RecordFormat format);
Content content_of(const ReportArguments& report);

/// Identity of a file. Two paths have equal identities if they refer to the same file, even through
/// links or different folders. New files whose names differ only in case have equal identities,
/// because some file systems ignore case.
struct FileIdentity {
    std::uint64_t device = 0;
    std::uint64_t file = 0;  ///< number of the file, or of its folder if the file does not exist
    std::string new_name;    ///< file name in lower case, or empty if the file exists
    auto operator<=>(const FileIdentity&) const = default;
};

/// Returns the identity of a file, or none for a device, a pipe, or a name in a nonexistent folder.
std::optional<FileIdentity> identity_of(const std::string& path);

/// The files of one run. An empty path means that there is no file. The functions throw BadArgument
/// if a file is rejected. The message contains the names of both options.
class RunFiles {
  public:
    /// Registers an input. `option` is the flag, or empty for a positional argument. The path "-"
    /// is standard input.
    void reads(const std::string& option, const std::string& path);
    void reads(const std::string& option, const std::vector<std::string>& paths);

    /// Registers an output. Rejects a file extension of an image or video that does not match
    /// `content`. For example, in `-o frames/*.png` the name of the output was forgotten, and the
    /// shell inserts the first frame as the output, which would be overwritten. The path "-" is
    /// standard output for `-o`, and is rejected for other options.
    void writes(const std::string& option, const std::string& path, Content content);

    /// Registers the output of lines: the file given by `-o`, or standard output without `-o`.
    void writes_lines(const std::string& path, Content content);

    /// Registers a file that is read, changed and rewritten, or created if it does not exist.
    void updates(const std::string& option, const std::string& path, Content content);

    /// Checks an input like `reads`, but does not store its name, because a run may have any number
    /// of inputs.
    void require_not_written(const std::string& path) const;

    /// Checks an output like `writes`, but does not store its name. Meant for generated names:
    /// these differ from each other, so they need not be compared.
    void require_free(const std::string& option, const std::string& path) const;

  private:
    void add_input(const std::string& label, const std::optional<FileIdentity>& identity);
    void add_output(const std::string& label, const std::optional<FileIdentity>& identity);
    void require_free(const std::string& label, const FileIdentity& identity) const;

    std::map<FileIdentity, std::string> inputs_;  ///< names as specified by the user
    std::map<FileIdentity, std::string> outputs_;
};

}  // namespace dotpose::cli
