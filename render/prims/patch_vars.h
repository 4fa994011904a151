// The variables of one surface: its own list, or a place in a mesh, which works them out when asked. Meshes
// of millions of faces keep their values once.
#pragma once

#include "render/prims/primvar.h"

#include <memory>

namespace render {

/// Variables of all the surfaces that one request makes; the same names and types for each.
class VarSource {
public:
  virtual ~VarSource() = default;
  virtual size_t count() const = 0;
  /// Variable `var` of surface `piece`.
  virtual PatchVar make(size_t var, uint32_t piece) const = 0;
  /// Whether a variable that replaces no predefined one is constant on each piece, but not the same on all.
  virtual bool differs_by_piece() const { return true; }
  /// Adds a variable if this is the list of a single surface.
  virtual bool append(PatchVar&) { return false; }
};

/// Reads like a container of PatchVar, but makes each when it is asked for.
class PatchVars {
public:
  PatchVars() = default;
  PatchVars(std::shared_ptr<VarSource> source, uint32_t piece) : source_(std::move(source)), piece_(piece) {}

  size_t size() const { return source_ ? source_->count() : 0; }
  bool empty() const { return size() == 0; }
  PatchVar operator[](size_t i) const { return source_->make(i, piece_); }
  void push_back(PatchVar var);
  /// The same without a part in the life of the source.
  PatchVars unowned() const {
    return source_ ? PatchVars({std::shared_ptr<void>(), source_.get()}, piece_) : PatchVars();
  }
  /// Surfaces with the same source have variables of the same names.
  const VarSource* source() const { return source_.get(); }

  class Iterator {
  public:
    Iterator(const PatchVars& vars, size_t at) : vars_(vars), at_(at) {}
    PatchVar operator*() const { return vars_[at_]; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator!=(const Iterator& o) const { return at_ != o.at_; }

  private:
    const PatchVars& vars_;
    size_t at_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

private:
  std::shared_ptr<VarSource> source_;
  uint32_t piece_ = 0;
};

} // namespace render
