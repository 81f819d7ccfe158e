/// The files of one run. No output may be one of its inputs, and no two outputs the same file:
/// every command tells its files here before it opens one.
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

namespace dotpose::cli {

/// The kind of data in an output file; `own`: the ending of its name chooses the format.
enum class Content { json, csv, yaml, svg, packets, own };

Content content_of(RecordFormat format);

/// Two names with equal identities are one file, also if they differ in links or folders; names of
/// new files also if they differ in upper and lower case.
struct FileIdentity {
    dev_t device = 0;
    ino_t inode = 0;       ///< of the file, or of the folder of a file that does not exist yet
    std::string new_name;  ///< in lower case; empty if the file exists
    auto operator<=>(const FileIdentity&) const = default;
};

/// None for what is no file and cannot become one: devices, pipes, names in folders that do not
/// exist.
std::optional<FileIdentity> identity_of(const std::string& path);

/// All names may be empty: no file. What is refused throws BadArgument, which names both options.
class RunFiles {
  public:
    /// `option` is the flag, or empty for an argument without one; "-" is standard input.
    void reads(const std::string& option, const std::string& path);
    void reads(const std::string& option, const std::vector<std::string>& paths);

    /// Text and pictures are refused where the name ends like an image or video of another kind:
    /// who forgets the name of the output of `-o frames/*.png` would lose the first frame.
    void writes(const std::string& option, const std::string& path, Content content);

    /// Lines to `-o`, or without it to standard output.
    void writes_lines(const std::string& path, Content content);

    /// An input that is changed after it was read, so that nothing of it is lost, and made if
    /// missing.
    void updates(const std::string& option, const std::string& path, Content content);

    /// Refuses an input as `reads` does, and forgets it: for names without end.
    void require_not_written(const std::string& path) const;

    /// Refuses an output as `writes` does, and forgets it: for names that are made up so that they
    /// differ from each other.
    void require_free(const std::string& option, const std::string& path) const;

  private:
    void add_output(const std::string& label, const std::string& path);
    void require_free(const std::string& label, const FileIdentity& identity) const;

    std::map<FileIdentity, std::string> inputs_;  ///< and what the user called them
    std::map<FileIdentity, std::string> outputs_;
};

}  // namespace dotpose::cli
