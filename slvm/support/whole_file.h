// Files that appear under their name only when they are complete: written under a temporary name beside it,
// then renamed. PUBLIC. A program that is killed leaves at most the temporary file, which whoever writes the
// same file next removes.
#pragma once

#include <string>

namespace slvm {

class WholeFile {
public:
  /// Removes what programs that were killed left of this file. Nothing is written yet.
  explicit WholeFile(std::string name);
  /// Removes the temporary file unless it was committed.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Where to write: NAME.MACHINE-PROCESS-THREAD.part, in the folder of the file.
  const std::string& temporary() const { return temporary_; }
  /// Gives it its name, in place of what was there. "": done, else why not.
  std::string commit();

private:
  std::string name_, temporary_;
  bool done_ = false;
};

/// The whole of a small file. "": done, else why not.
std::string write_whole_file(const std::string& name, const void* data, size_t bytes);

} // namespace slvm
