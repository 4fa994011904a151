// Shared libraries that are opened while a program runs: plug-ins. PUBLIC. They are native code: whoever
// opens one looks only in folders that the user of the program named, on its command line or in the
// environment.
#pragma once

#include "slvm/support/result.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace slvm {

class SharedLibrary {
public:
  /// Everything the library needs of others must be there. The error names the file and what is wrong with
  /// it. Code of the library may run in here.
  static Result<std::shared_ptr<const SharedLibrary>> open(const std::string& path);
  ~SharedLibrary();
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  const std::string& path() const { return path_; }
  /// The address of an exported name, or null. It is valid as long as the library.
  void* symbol(const std::string& name) const;
  /// Bytes that the variable at this address, one of symbol(), takes; 0 when that is not known.
  size_t size_of(const void* symbol) const;

private:
  SharedLibrary(std::string path, void* handle) : path_(std::move(path)), handle_(handle) {}
  std::string path_;
  void* handle_;
};

/// The file of the plug-in `name` in the first of the folders that has it: the name as it stands, with ".so",
/// or as lib<name>.so. Neither "..", nor links, nor absolute names lead out of the folders; of an absolute
/// name, as scenes from other machines have, the last part counts where it is in none of them. "" when there
/// is none.
std::string find_library(std::string_view name, std::span<const std::string> folders);
/// All shared libraries in the folders, folder by folder, by name.
std::vector<std::string> list_libraries(std::span<const std::string> folders);

/// The environment variable that names folders of plug-ins, and the switch of all programs that does.
inline constexpr const char* kPluginFoldersVariable = "ANEMONE_DSO_PATH";
inline constexpr const char* kPluginFoldersSwitch = "--dso";
/// The folder of the plug-ins that come with Anemone, which programs trust as they trust themselves: beside
/// the program, as built or as installed. "" when there is none.
std::string standard_plugin_folder();
/// The folders of the switch's text, then those of the environment, then the standard one.
std::vector<std::string> plugin_folders(std::string_view text);
/// What to do about a plug-in that is not in the folders: says that the user gave none, or which were
/// searched.
std::string plugin_folders_advice(std::span<const std::string> folders);

} // namespace slvm
