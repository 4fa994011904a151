// The surface of an area light: where its samples are, and what its shader reads there.
//
// Points are as dense as the surface is large. Each primitive has a lattice over its parameter square with
// the area that a piece of the square becomes, |dPdu x dPdv|, at its corners, bilinear between them; a pair
// of numbers goes to a row of all rows of all primitives and a place within it by the first one, to a place
// along the row by the second. So what is evenly spread over the unit square is over the surface, too. The
// surface is taken as it is when the shutter opens, without displacement.
#pragma once

#include "render/prims/dice.h"
#include "render/prims/primitive_list.h"
#include "slvm/light_emitter.h"

#include <memory>
#include <string>
#include <vector>

namespace render {

class AreaEmitter final : public slvm::LightEmitter {
public:
  /// `samples` for each lit point. The context's string pool must outlive this.
  AreaEmitter(PrimitiveList surface, uint32_t samples, const DiceContext& context);

  /// In camera space.
  double area() const { return row_ends_.empty() ? 0 : row_ends_.back(); }

  uint32_t samples() const override { return samples_; }
  void place(std::span<const float> x, std::span<const float> y, const slvm::Program& reader,
             slvm::Grid& grid) const override;

private:
  /// The lattice of a primitive: at each corner the area by (u, v), and its integral from u = 0.
  struct Lattice {
    int nu = 1, nv = 1;
    std::vector<float> area, integral;
    size_t at(int i, int j) const {
      return static_cast<size_t>(j) * static_cast<size_t>(nu + 1) + static_cast<size_t>(i);
    }
  };
  struct Row {
    uint32_t primitive;
    int row;
    float du, dv; ///< of a cell
  };
  /// A point of the surface, and the point of a grid it is for.
  struct Spot {
    uint32_t primitive;
    uint32_t point;
    float u, v;
  };

  void sort_primitives();
  void measure(const Primitive& primitive, Lattice& lattice) const;
  void find_shared_variables();
  Spot spot(float x, float y) const;
  void fill(std::span<const Spot> spots, const ReadVariables& read, slvm::Grid& part) const;

  PrimitiveList surface_;             ///< keeps what `primitives_` refer to
  std::vector<Primitive> primitives_; ///< those that can be diced together side by side
  std::vector<uint32_t> group_;       ///< of each primitive: which of those it is
  std::vector<Lattice> lattices_;
  std::vector<Row> rows_;
  std::vector<double> row_ends_;    ///< area up to the end of each row
  std::vector<uint32_t> guide_;     ///< for each of as many equal parts of the area: the row it begins in
  std::vector<std::string> shared_; ///< variables that all primitives have
  uint32_t samples_;
  DiceContext context_;
};

} // namespace render
