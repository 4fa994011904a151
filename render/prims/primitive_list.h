// The surfaces of a scene, in order. What one request makes is kept as one thing: its state, and the pieces
// it comes to, which instances of it share; a Primitive is put together when somebody asks for it. So a mesh
// of millions of faces is a few arrays, and hundreds of instances of it are little more than that.
#pragma once

#include "render/prims/primitive.h"

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace render {

/// The surfaces of one request, wherever it stands.
class Pieces {
public:
  /// So many neighbours have a box in common.
  static constexpr uint32_t kBlock = 2048;

  virtual ~Pieces() = default;
  virtual uint32_t count() const = 0;
  /// All of a primitive but its state. Pointers in it need not keep alive what these pieces do.
  virtual Primitive piece(uint32_t k) const = 0;
  /// Whether all have variables of the same kinds, and the same values where these are constant on each piece
  /// (VarSource::differs_by_piece).
  virtual bool vars_are_alike() const { return count() == 1; }
  /// Whether any of them changes its shape.
  virtual bool deforms() const { return false; }

  /// Boxes of the pieces [0, kBlock), [kBlock, 2 kBlock)... in object space, at all times. Made when first
  /// asked for, by any thread.
  std::span<const Box> blocks() const;

private:
  mutable std::once_flag measured_;
  mutable std::vector<Box> blocks_;
};

/// A pointer that keeps nothing alive: to hand on what lives anyway, at no cost.
template <class T> std::shared_ptr<T> unowned(T* at) {
  return {std::shared_ptr<void>(), at};
}

class PrimitiveList {
public:
  /// The surfaces of a request: numbers [first, first + count).
  struct Run {
    std::shared_ptr<const PrimitiveState> state;
    std::shared_ptr<const Pieces> pieces;
    uint32_t first = 0, count = 0;

    const Attributes& attributes() const { return *state->attributes; }
    bool moves() const { return !state->motion.empty() || pieces->deforms(); }
    Primitive primitive(uint32_t k) const {
      Primitive p = pieces->piece(k);
      p.state = unowned(state.get());
      return p;
    }
    /// Box of block `b` in camera space, displacement and motion included.
    Box camera_bound(size_t b) const { return state->camera_bound(pieces->blocks()[b]); }
    Box camera_bound() const;
  };

  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Valid as long as the list, or a copy of it, has the primitive.
  Primitive operator[](size_t i) const {
    const Run& r = run_of(i);
    return r.primitive(static_cast<uint32_t>(i) - r.first);
  }
  const PrimitiveState& state(size_t i) const { return *run_of(i).state; }
  Primitive back() const { return (*this)[size_ - 1]; }
  std::span<const Run> runs() const { return runs_; }
  const Run& run_of(size_t i) const { return runs_[run_number(i)]; }
  size_t run_number(size_t i) const;

  /// Nothing is added when there are no pieces.
  void add(std::shared_ptr<const PrimitiveState> state, std::shared_ptr<const Pieces> pieces);
  /// These share `state`, whatever theirs is.
  void add(std::shared_ptr<const PrimitiveState> state, std::vector<Primitive> primitives);
  void push_back(Primitive primitive);
  void append(PrimitiveList&& more);
  void pop_back() { take_from(size_ - 1); }
  /// Takes away all from number `first` on, which is the first of a run.
  PrimitiveList take_from(size_t first);

  class Iterator {
  public:
    Iterator(const PrimitiveList& list, size_t run) : list_(&list), run_(run) {}
    Primitive operator*() const { return list_->runs_[run_].primitive(k_); }
    Iterator& operator++() {
      if (++k_ == list_->runs_[run_].count) ++run_, k_ = 0;
      return *this;
    }
    bool operator!=(const Iterator& o) const { return run_ != o.run_ || k_ != o.k_; }

  private:
    const PrimitiveList* list_;
    size_t run_;
    uint32_t k_ = 0;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, runs_.size()}; }

private:
  std::vector<Run> runs_;
  uint32_t size_ = 0;
};

/// Pieces that are kept one by one.
class ListedPieces final : public Pieces {
public:
  explicit ListedPieces(std::vector<Primitive> list);
  uint32_t count() const override { return static_cast<uint32_t>(list_.size()); }
  Primitive piece(uint32_t k) const override;

private:
  std::vector<Primitive> list_;
};

/// Pieces of a mesh, which keeps small geometries side by side, patches(), and is the source of their
/// variables. finish(k, primitive) sets what else they have.
template <class Mesh, class Finish> class MeshPieces final : public Pieces {
public:
  MeshPieces(std::shared_ptr<Mesh> mesh, Finish finish)
      : mesh_(std::move(mesh)), finish_(std::move(finish)) {}
  uint32_t count() const override { return static_cast<uint32_t>(mesh_->patches().size()); }
  Primitive piece(uint32_t k) const override {
    Primitive p;
    p.geometry = unowned<const Geometry>(&mesh_->patches()[k]);
    if (mesh_->count() > 0) p.vars = PatchVars(unowned<VarSource>(mesh_.get()), k);
    finish_(k, p);
    return p;
  }
  bool vars_are_alike() const override { return mesh_->count() == 0 || !mesh_->differs_by_piece(); }

private:
  std::shared_ptr<Mesh> mesh_;
  Finish finish_;
};

template <class Mesh, class Finish>
std::shared_ptr<const Pieces> pieces_of(std::shared_ptr<Mesh> mesh, Finish finish) {
  return std::make_shared<MeshPieces<Mesh, Finish>>(std::move(mesh), std::move(finish));
}
template <class Mesh> std::shared_ptr<const Pieces> pieces_of(std::shared_ptr<Mesh> mesh) {
  return pieces_of(std::move(mesh), [](uint32_t, Primitive&) {});
}

} // namespace render
