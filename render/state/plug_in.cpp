// Loading of plug-ins.
#include "render/state/plug_in.h"

#include <fmt/format.h>

#include <exception>

namespace render {

namespace {

template <class Function>
bool look_up(const slvm::SharedLibrary& library, const char* name, Function& out, std::string& missing) {
  out = reinterpret_cast<Function>(library.symbol(name));
  if (!out) missing += (missing.empty() ? "" : ", ") + std::string(name);
  return out;
}

} // namespace

slvm::Result<std::shared_ptr<PlugIn>> PlugIn::open(const std::string& file) {
  auto library = slvm::SharedLibrary::open(file);
  if (!library) return slvm::Error{fmt::format("it cannot be loaded: {}", library.error())};
  std::shared_ptr<PlugIn> out(new PlugIn(*library));
  std::string missing;
  look_up(**library, "ConvertParameters", out->convert_parameters_, missing);
  look_up(**library, "Subdivide", out->subdivide_, missing);
  look_up(**library, "Free", out->free_, missing);
  if (!missing.empty())
    return slvm::Error{fmt::format("\"{}\" does not define {}; a plug-in has ConvertParameters, Subdivide "
                                   "and Free, with C linkage",
                                   file, missing)};
  return out;
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
  if (std::string file = slvm::find_library(name, trusted); !file.empty()) return PlugIn::open(file);
  std::string hint;
  if (std::string elsewhere = slvm::find_library(name, others); !elsewhere.empty())
    hint = fmt::format("; \"{}\" is not loaded, because only the scene names its folder", elsewhere);
  return slvm::Error{
      fmt::format("no such plug-in in the folders of --procedurals \"{}\"{}", fmt::join(trusted, ":"), hint)};
}

} // namespace render
