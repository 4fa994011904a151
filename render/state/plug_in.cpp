// Loading of plug-ins.
#include "render/state/plug_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <dlfcn.h>
#include <exception>
#include <filesystem>
#include <optional>

namespace render {

namespace {

namespace fs = std::filesystem;

/// Whether a path with all links followed lies in the folder, also in one further down.
bool lies_in(const fs::path& file, const fs::path& folder) {
  auto [f, unused] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return f == folder.end();
}

/// A file of this name in the folders: "../x" and links lead no farther than these. An absolute name, as
/// scenes from other machines have, counts when it is in one of them, else its last part does.
std::optional<std::string> find(const std::string& name, const std::vector<std::string>& folders) {
  std::error_code error;
  for (const std::string& wanted : {name, name + ".so"})
    for (const fs::path& path : {fs::path(wanted), fs::path(wanted).filename()})
      for (const std::string& f : folders) {
        fs::path folder = fs::canonical(f.empty() ? "." : f, error);
        if (error) continue;
        fs::path file = fs::canonical(folder / path, error); // an absolute path stays itself
        if (!error && fs::is_regular_file(file, error) && lies_in(file, folder)) return file.string();
      }
  return {};
}

template <class Function> bool look_up(void* library, const char* name, Function& out, std::string& missing) {
  out = reinterpret_cast<Function>(::dlsym(library, name));
  if (!out) missing += (missing.empty() ? "" : ", ") + std::string(name);
  return out;
}

} // namespace

slvm::Result<std::shared_ptr<PlugIn>> PlugIn::open(const std::string& file) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    const char* why = ::dlerror();
    return slvm::Error{fmt::format("it cannot be loaded: {}", why ? why : "the system does not say why")};
  }
  std::shared_ptr<PlugIn> out(new PlugIn(library));
  std::string missing;
  look_up(library, "ConvertParameters", out->convert_parameters_, missing);
  look_up(library, "Subdivide", out->subdivide_, missing);
  look_up(library, "Free", out->free_, missing);
  if (!missing.empty())
    return slvm::Error{fmt::format("\"{}\" does not define {}; a plug-in has ConvertParameters, Subdivide "
                                   "and Free, with C linkage",
                                   file, missing)};
  return out;
}

PlugIn::~PlugIn() {
  ::dlclose(library_);
}

std::string PlugIn::make(std::string parameters, float detail) const {
  try {
    void* data = convert_parameters_(parameters.data());
    subdivide_(data, detail);
    free_(data);
  } catch (const std::exception& e) {
    return fmt::format("it threw an exception: {}", e.what());
  } catch (...) {
    return "it threw an exception";
  }
  return {};
}

slvm::Result<std::shared_ptr<PlugIn>> load_plug_in(const std::string& name,
                                                   const std::vector<std::string>& trusted,
                                                   const std::vector<std::string>& others) {
  if (trusted.empty())
    return slvm::Error{"plug-ins are loaded only from folders named with --procedurals (or in "
                       "ANEMONE_PROCEDURALS), and none is"};
  if (auto file = find(name, trusted)) return PlugIn::open(*file);
  std::string hint;
  if (auto elsewhere = find(name, others))
    hint = fmt::format("; \"{}\" is not loaded, because only the scene names its folder", *elsewhere);
  return slvm::Error{
      fmt::format("no such plug-in in the folders of --procedurals \"{}\"{}", fmt::join(trusted, ":"), hint)};
}

} // namespace render
