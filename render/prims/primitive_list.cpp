// Runs of primitives.
#include "render/prims/primitive_list.h"

#include <algorithm>
#include <cassert>

namespace render {

std::span<const Box> Pieces::blocks() const {
  std::call_once(measured_, [this] {
    const uint32_t n = count();
    blocks_.resize((n + kBlock - 1) / kBlock);
    for (uint32_t k = 0; k < n; ++k)
      blocks_[k / kBlock].add(piece(k).bound({}));
  });
  return blocks_;
}

/// Not larger than it must be where that is cheap.
Box PrimitiveList::Run::camera_bound() const {
  Box box;
  for (uint32_t k = 0; k < count && count <= Pieces::kBlock; ++k)
    box.add(primitive(k).camera_bound({}));
  if (!box.empty()) return box;
  for (size_t b = 0; b < pieces->blocks().size(); ++b)
    box.add(camera_bound(b));
  return box;
}

size_t PrimitiveList::run_number(size_t i) const {
  assert(i < size_);
  if (runs_.size() == size_) return i; // of one primitive each
  auto after = std::upper_bound(runs_.begin(), runs_.end(), i,
                                [](size_t number, const Run& r) { return number < r.first; });
  return static_cast<size_t>(after - runs_.begin()) - 1;
}

void PrimitiveList::add(std::shared_ptr<const PrimitiveState> state, std::shared_ptr<const Pieces> pieces) {
  const uint32_t count = pieces->count();
  if (count == 0) return;
  runs_.push_back({std::move(state), std::move(pieces), size_, count});
  size_ += count;
}

void PrimitiveList::add(std::shared_ptr<const PrimitiveState> state, std::vector<Primitive> primitives) {
  add(std::move(state), std::make_shared<ListedPieces>(std::move(primitives)));
}

void PrimitiveList::push_back(Primitive primitive) {
  auto state = primitive.state;
  std::vector<Primitive> one;
  one.push_back(std::move(primitive));
  add(std::move(state), std::move(one));
}

void PrimitiveList::append(PrimitiveList&& more) {
  for (Run& r : more.runs_)
    add(std::move(r.state), std::move(r.pieces));
  more = {};
}

PrimitiveList PrimitiveList::take_from(size_t first) {
  PrimitiveList taken;
  auto from = std::find_if(runs_.begin(), runs_.end(), [&](const Run& r) { return r.first >= first; });
  for (auto r = from; r != runs_.end(); ++r)
    taken.add(std::move(r->state), std::move(r->pieces));
  runs_.erase(from, runs_.end());
  size_ -= taken.size_;
  return taken;
}

ListedPieces::ListedPieces(std::vector<Primitive> list) : list_(std::move(list)) {
  for (Primitive& p : list_)
    p.state = nullptr; // that of the run counts
}

Primitive ListedPieces::piece(uint32_t k) const {
  const Primitive& p = list_[k];
  Primitive out;
  out.geometry = unowned(p.geometry.get());
  out.vars = p.vars.unowned();
  out.uv = p.uv;
  out.one_across = p.one_across;
  return out;
}

} // namespace render
