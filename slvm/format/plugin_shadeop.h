// Functions of plug-ins (DSO shadeops) as the compiler and compiled code know them: name, signature, library.
// PUBLIC. What is in a library and how it is called: slvm/plugin. A program and a module each have a list of
// those they call; their ids begin at kFirstPluginShadeop and mean something with that list only.
#pragma once

#include "slvm/format/shadeop_info.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slvm {

/// Parameters a function of a plug-in may have.
inline constexpr size_t kMaxPluginParams = 64;

enum class PluginForm : uint8_t {
  kPointwise, ///< shadeop.h: called for each point
  kGrid,      ///< RslPlugin.h: called once for all points
  kGridArray, ///< the same, and it returns an array: that is its first parameter here
};
inline constexpr int kPluginFormCount = 3;

/// What identifies a function: all that a file keeps.
struct PluginFunctionName {
  std::string function;
  /// Its signature in the grammar of signature.h; every parameter has a name. "varying" in front of the
  /// result: it varies whatever the arguments do.
  std::string signature;
  std::string library; ///< path of the file under which the compiler found it
  PluginForm form = PluginForm::kPointwise;
  bool operator==(const PluginFunctionName&) const = default;
};

/// One function of a plug-in. Immutable; `info` points into it.
class PluginShadeop {
public:
  /// Null when the signature does not follow the grammar, or asks for what functions of plug-ins do not have.
  static std::shared_ptr<const PluginShadeop> make(PluginFunctionName name);
  PluginShadeop(const PluginShadeop&) = delete;
  PluginShadeop& operator=(const PluginShadeop&) = delete;

  const PluginFunctionName& name() const { return name_; }
  const ShadeopInfo& info() const { return info_; }
  /// The same function as a call sees it that lets it store to more parameters, those that are true:
  /// functions called by point may write to any variable they are given.
  std::shared_ptr<const PluginShadeop> storing_to(const std::vector<bool>& params) const;

private:
  explicit PluginShadeop(PluginFunctionName name) : name_(std::move(name)) {}
  PluginFunctionName name_;
  std::vector<SignatureParam> params_;
  ShadeopInfo info_{};
};

/// The functions of plug-ins that one program or module calls.
class PluginShadeops {
public:
  static constexpr size_t kMost = 4096;

  /// The id of this function in the list, to which it is added unless an equal one is there. Nullopt: the
  /// list is full.
  std::optional<ShadeopId> add(std::shared_ptr<const PluginShadeop> function);
  /// Null for ids that are not in this list, those of built-ins among them.
  const PluginShadeop* find(ShadeopId id) const {
    if (id < kFirstPluginShadeop) return nullptr;
    const auto index = static_cast<size_t>(id - kFirstPluginShadeop);
    return index < list_.size() ? list_[index].get() : nullptr;
  }
  /// The row of the table or the function of a plug-in; the id must be one of either.
  const ShadeopInfo& info(uint32_t id) const {
    const PluginShadeop* own = find(static_cast<ShadeopId>(id));
    return own ? own->info() : shadeop(static_cast<ShadeopId>(id));
  }
  /// True when info() may be asked.
  bool knows(uint32_t id) const {
    return id < shadeops().size() || (id <= 0xffff && find(static_cast<ShadeopId>(id)));
  }
  const std::vector<std::shared_ptr<const PluginShadeop>>& list() const { return list_; }
  /// Paths of the libraries, sorted, none twice.
  std::vector<std::string> libraries() const;

  bool operator==(const PluginShadeops& other) const;

private:
  std::vector<std::shared_ptr<const PluginShadeop>> list_;
};

/// Finds functions of plug-ins for the compiler, which opens no libraries itself: tools hand in
/// slvm::PluginFinder of slvm/plugin/finder.h.
class PluginSource {
public:
  virtual ~PluginSource() = default;
  using Functions = std::vector<std::shared_ptr<const PluginShadeop>>;

  /// The functions of this name, overloads in the order of their table; empty when no library on the path has
  /// one. `trouble`: what was wrong with libraries that might have had it, a sentence each.
  virtual Functions find(std::string_view function, std::vector<std::string>& trouble) const = 0;
  /// All functions called by grid of the library of this name, for the statement `plugin "name";`. False:
  /// there is none, or it cannot be used, which `trouble` tells.
  virtual bool load(std::string_view library, Functions& functions,
                    std::vector<std::string>& trouble) const = 0;
  /// The functions called by point of this name in a library that load() found: it cannot list those.
  virtual Functions find_in(std::string_view library, std::string_view function,
                            std::vector<std::string>& trouble) const = 0;
};

} // namespace slvm
