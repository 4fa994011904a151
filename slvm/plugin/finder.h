// Finds functions of plug-ins for the compiler, in folders that the user gave. PUBLIC. Libraries are opened
// when a function is asked for that nothing else has: first those named after it, then all others, in order.
// Thread-safe.
#pragma once

#include "slvm/plugin/library.h"

#include <mutex>

namespace slvm {

class PluginFinder : public PluginSource {
public:
  explicit PluginFinder(std::vector<std::string> folders) : folders_(std::move(folders)) {}

  Functions find(std::string_view function, std::vector<std::string>& trouble) const override;
  bool load(std::string_view library, Functions& functions, std::vector<std::string>& trouble) const override;
  Functions find_in(std::string_view library, std::string_view function,
                    std::vector<std::string>& trouble) const override;

private:
  /// Opened now or earlier; null with its error in `error`.
  std::shared_ptr<const PluginLibrary> open(const std::string& path, std::string& error) const;

  std::vector<std::string> folders_;
  mutable std::mutex mutex_;
  struct Opened {
    std::shared_ptr<const PluginLibrary> library;
    std::string error;
  };
  mutable std::map<std::string, Opened> opened_; // by path
};

} // namespace slvm
